// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The balls' side of an exchange with slurryFoam, for tests: a heap of balls that stays where it is, whatever the
/// flow tells it. `fixed_balls FOLDER FILE` writes the numbers of each message of forces to FILE; the first is the time.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>

#include "averaging/exchange/exchange_fields.hpp"

namespace
{

using namespace millfoam::averaging;

/// The mesh of slurry_case.py.
const BoxGrid
    grid({0, 0, 0}, {0.14, 0.1, 0.02}, {14, 10, 2}, {false, false, false});

SolidsAt heap(double time)
{
    const double volume = 1e-6;
    SolidsAt balls;
    balls.time = time;
    balls.fields.velocity.assign(3 * grid.size(), 0);
    balls.fields.diameter.assign(grid.size(), 0.005);
    balls.fields.diameter43 = balls.fields.diameter;
    for (std::size_t cell = 0; cell < grid.size(); ++cell)
    {
        const double x = 0.01 * (0.5 + static_cast<double>(cell % 14));
        const double y = 0.01 * (0.5 + static_cast<double>(cell / 14 % 10));
        balls.fields.solidity.push_back(
            0.55 * std::exp(
                       -std::pow((x - 0.07) / 0.03, 2) -
                       std::pow((y - 0.02) / 0.03, 2)));
        balls.fields.velocity[3 * cell] = 0.1;
        balls.deposited += volume * balls.fields.solidity.back();
    }
    return balls;
}

void answer(const char* folder, const char* told)
{
    ExchangePipes pipes(folder, ExchangeSide::balls);
    double time = unpack_flow_offer(pipes.receive(FlowOffer::kind)).time;
    pipes.send(pack(BallsOffer{grid, 0, std::nullopt, "fixed_balls", ""}));
    std::ofstream out(told);
    out.precision(17);
    while (true)
    {
        pipes.send(pack(heap(time)));
        const ExchangeMessage message = pipes.receive();
        if (message.kind != ForcesUntil::kind)
            return;
        time = unpack_forces(message, grid.size()).time;
        for (const double number : message.numbers)
            out << number << ' ';
        out << '\n';
    }
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3)
        return 2;
    try
    {
        answer(argv[1], argv[2]);
    }
    catch (const std::exception& error)
    {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
