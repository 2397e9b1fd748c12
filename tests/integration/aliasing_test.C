/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    aliasing_test

Description
    `tensorField & tmp<vectorField>` against a plain loop.

    The operator stores its result in its second operand while both are
    declared __restrict__. Compiled with GCC's loop vectoriser it reads what
    it has overwritten, and fvc::reconstruct, which every step of interFoam
    calls, is built on it. The flags of FindOpenFOAM keep it right; exit code 1
    when they do not.

\*---------------------------------------------------------------------------*/

#include "tensorField.H"
#include "vectorField.H"
#include "tmp.H"
#include "IOstreams.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- Both kinds of first operand, as in OpenFOAM's own libraries: with one alone
//  GCC inlines the loop, sees that the operands share storage and is right.
//  Apart from main, which runs only once and is not vectorised.
__attribute__((noinline)) tmp<vectorField>
product(const tensorField& T, const tmp<vectorField>& v)
{
    return T & v;
}


__attribute__((noinline)) tmp<vectorField>
product(const tmp<tensorField>& T, const tmp<vectorField>& v)
{
    return T & v;
}


//- Number of entries of `found` that are not T & v
static label
countWrong(const vectorField& found, const tensorField& T, const vectorField& v)
{
    label wrong = 0;
    forAll(found, i)
    {
        const tensor& t = T[i];
        const vector& w = v[i];
        const vector expected(
            t.xx() * w.x() + t.xy() * w.y() + t.xz() * w.z(),
            t.yx() * w.x() + t.yy() * w.y() + t.yz() * w.z(),
            t.zx() * w.x() + t.zy() * w.y() + t.zz() * w.z());
        if (found[i] != expected)
        {
            ++wrong;
        }
    }
    return wrong;
}


int main()
{
    const label size = 5000;
    tensorField T(size);
    vectorField v(size);
    forAll(T, i)
    {
        // Small whole numbers: products and sums are exact
        T[i] = tensor(
            i % 7, i % 11, i % 13, i % 17, i % 19, i % 23, i % 29, i % 31,
            i % 37);
        v[i] = vector(1 + i % 5, 2 + i % 3, 3 + i % 4);
    }

    const vectorField first(product(T, tmp<vectorField>::New(v)));
    const vectorField second(
        product(tmp<tensorField>::New(T), tmp<vectorField>::New(v)));
    const label wrong = countWrong(first, T, v) + countWrong(second, T, v);

    Info << wrong << " of " << 2 * size
         << " products differ from the plain loop" << endl;
    return wrong ? 1 : 0;
}


// ************************************************************************* //
