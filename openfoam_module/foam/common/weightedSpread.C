/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "weightedSpread.H"
#include "ListListOps.H"
#include "Pstream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The values of all ranks, on the master
static scalarField gathered(const scalarField& values)
{
    List<scalarField> parts(Pstream::nProcs());
    parts[Pstream::myProcNo()] = values;
    Pstream::gatherList(parts);
    return Pstream::master() ? ListListOps::combine<scalarField>(
                                   parts, accessOp<scalarField>())
                             : scalarField();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::weightedSpread
Foam::spreadOf(const scalarField& values, const scalarField& weights)
{
    const scalarField value(gathered(values));
    const scalarField weight(gathered(weights));
    weightedSpread result;
    const scalar all = sum(weight);
    if (!(all > 0))
    {
        return result;
    }
    result.mean = sum(value * weight) / all;

    scalar below = 0;
    for (const label i : sortedOrder(value))
    {
        if (weight[i] > 0)
        {
            if (below < 0.95 * all)
            {
                result.high = value[i];
            }
            result.largest = value[i];
            below += weight[i];
        }
    }
    return result;
}


// ************************************************************************* //
