/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    In a shell without WM_PROJECT_DIR, a program finds the OpenFOAM that it was
    built with. If that does not exist, it finds Debian's.

    OpenFOAM's library looks for etc/controlDict of WM_PROJECT_DIR before main()
    begins. If there is none, it ends the program, also with --version. Functions
    in .preinit_array run before all libraries. The one here starts the program
    again with that variable, unless it is set. Only system calls of libc are
    sure to work there, and no object of the program.

\*---------------------------------------------------------------------------*/

#include <cstring>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

static void findOpenFOAM(int, char** argv, char** envp)
{
    static char builtWith[] = "WM_PROJECT_DIR=" MILLFOAM_OPENFOAM_DIR;
    static char distribution[] = "WM_PROJECT_DIR=/usr/share/openfoam";
    static char program[4096];
    static char* environment[4096];

    std::size_t n = 0;
    for (; envp[n]; ++n)
    {
        if (std::strncmp(envp[n], "WM_PROJECT_DIR=", 15) == 0)
        {
            return;
        }
    }
    if (n + 2 > sizeof(environment) / sizeof(*environment) ||
        readlink("/proc/self/exe", program, sizeof(program) - 1) < 0)
    {
        return;
    }
    std::memcpy(environment, envp, n * sizeof(*envp));
    environment[n] =
        access(builtWith + 15, F_OK) == 0 ? builtWith : distribution;
    execve(program, argv, environment);
}


__attribute__((section(".preinit_array"), used)) static void (*const findFirst)(
    int, char**, char**) = findOpenFOAM;


// ************************************************************************* //
