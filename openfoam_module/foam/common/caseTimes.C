/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "caseTimes.H"
#include "OSspecific.H"
#include "scalar.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::instantList Foam::timesIn(const fileName& folder)
{
    instantList found;
    for (const fileName& name : readDir(folder, fileName::DIRECTORY))
    {
        scalar time = 0;
        if (readScalar(name, time))
        {
            found.append(instant(time, word(name)));
        }
    }
    std::sort(
        found.begin(), found.end(),
        [](const instant& a, const instant& b)
        { return a.value() < b.value(); });
    return found;
}


Foam::fileNameList Foam::rankFolders(const fileName& folder)
{
    fileNameList found;
    for (const fileName& name : readDir(folder, fileName::DIRECTORY))
    {
        if (name == "processor0" || name.find("processors") == 0)
        {
            found.append(folder / name);
        }
    }
    return found;
}


// ************************************************************************* //
