/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "uncoveredCells.H"
#include "readableLog.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::firstCells(const fvMesh& mesh, const labelUList& cells)
{
    const label few = 3;

    readableText own;
    for (label i = 0; i < min(few, cells.size()); ++i)
    {
        own << (i ? ", " : "") << "cell " << cells[i];
        if (Pstream::parRun())
        {
            own << " of processor " << Pstream::myProcNo();
        }
        own << " at " << mesh.C()[cells[i]] << " m";
    }

    const auto joined = [](const string& one, const string& other)
    {
        const bool both = !one.empty() && !other.empty();
        return string(one + (both ? ", " : "") + other);
    };
    string all = returnReduce(own.str(), joined);
    return returnReduce(cells.size(), maxOp<label>()) > few ? all + ", ..."
                                                            : all;
}


// ************************************************************************* //
