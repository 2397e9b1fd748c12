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

    List<string> texts(Pstream::nProcs());
    texts[Pstream::myProcNo()] = own.str();
    Pstream::gatherList(texts);
    Pstream::scatterList(texts);

    string all;
    for (const string& text : texts)
    {
        all += (all.empty() || text.empty() ? "" : ", ") + text;
    }
    return returnReduce(cells.size(), maxOp<label>()) > few ? all + ", ..."
                                                            : all;
}


// ************************************************************************* //
