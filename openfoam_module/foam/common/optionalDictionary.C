/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "optionalDictionary.H"
#include "IOdictionary.H"
#include "Time.H"
#include "fileOperation.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::IOobject Foam::optionalDictionary(
    const word& name, const objectRegistry& db, const bool registered)
{
    IOobject io(
        name, db.time().constant(), db, IOobject::NO_READ, IOobject::NO_WRITE,
        registered);
    const fileName file(
        fileHandler().filePath(true, io, IOdictionary::typeName));
    if (file.empty())
    {
        return io;
    }
    if (!io.typeHeaderOk<IOdictionary>(true))
    {
        FatalErrorInFunction
            << file << ": has no header 'FoamFile { … class dictionary; … }';"
            << " expected one at its beginning" << exit(FatalError);
    }
    io.readOpt() = IOobject::MUST_READ;
    return io;
}


// ************************************************************************* //
