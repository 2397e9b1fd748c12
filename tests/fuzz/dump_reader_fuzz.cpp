// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever bytes it is given, the dump reader gives a record or a DumpError. A record holds what it promises,
// is the same whether the text comes in one or in many pieces (which also sets the quick way to read numbers
// against the careful one), and, written out, is read back as it was.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>

#include "averaging/dumps/dump_rows.hpp"

namespace {

using namespace millfoam::averaging;

struct Outcome {
  std::optional<ParticleRecord> record;
  std::string error;
};

void require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "does not hold: " << what << '\n';
  std::abort();
}

Outcome read(TextLines lines, std::size_t bytes) {
  try {
    return {read_record(lines, bytes), {}};
  } catch (const DumpError& error) {
    return {std::nullopt, error.what()};
  }
}

/// Gives a text in pieces of `piece` bytes.
Outcome read_in_pieces(std::string_view text, std::size_t piece) {
  std::string present;
  std::size_t given = 0;
  const auto more = [&](std::string_view rest) {
    std::string next(rest);
    const std::string_view fresh = text.substr(given, piece);
    next.append(fresh);
    given += fresh.size();
    present.swap(next);
    return std::string_view(present);
  };
  return read(TextLines(more, "dump"), text.size());
}

bool is_finite(const Vector3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

void require_promises(const ParticleRecord& record, std::size_t bytes) {
  std::set<long long> ids;
  for (const Particle& p : record.particles) {
    require(is_finite(p.position) && is_finite(p.velocity), "positions and velocities are finite");
    require(p.radius > 0 && std::isfinite(p.radius), "a radius is positive and finite");
    require(ids.insert(p.id).second, "ids differ");
  }
  require(record.step >= 0, "a step is not negative");
  require(2 * record.particles.size() <= bytes, "a particle takes some text");
  require(record.shapes.empty() || record.shapes.size() == record.particles.size(),
          "all or none have shapes");
  for (std::size_t s = 0; s < record.shapes.size(); ++s) {
    const Superquadric& shape = record.shapes[s];
    for (const double axis : shape.half_axes) {
      require(axis > 0 && axis <= record.particles[s].radius, "half axes fit into the sphere around them");
    }
    for (const double n : shape.blockiness) require(n >= 2 && std::isfinite(n), "blockiness is 2 or more");
    double square = 0;
    for (const double component : shape.quaternion) square += component * component;
    require(std::abs(square - 1) < 1e-14, "a quaternion is of length 1");
  }
}

std::string written(const ParticleRecord& record) {
  std::ostringstream text;
  text.precision(17);
  text << "ITEM: TIMESTEP\n"
       << record.step << "\nITEM: NUMBER OF ATOMS\n"
       << record.particles.size() << "\nITEM: ATOMS vx vy vz x y z radius id";
  const bool shapes = !record.shapes.empty();
  if (shapes) text << " quat1 quat2 quat3 quat4 shapex shapey shapez blockiness1 blockiness2";
  text << '\n';
  const auto write = [&](const auto& values) {
    for (const double value : values) text << value << ' ';
  };
  for (std::size_t p = 0; p < record.particles.size(); ++p) {
    const Particle& particle = record.particles[p];
    write(particle.velocity);
    write(particle.position);
    text << particle.radius << ' ' << particle.id << ' ';
    if (shapes) {
      write(record.shapes[p].quaternion);
      write(record.shapes[p].half_axes);
      write(record.shapes[p].blockiness);
    }
    text << '\n';
  }
  return text.str();
}

bool same(const ParticleRecord& a, const ParticleRecord& b, double rounding) {
  const auto particle = [](const Particle& p, const Particle& q) {
    return p.id == q.id && p.position == q.position && p.velocity == q.velocity && p.radius == q.radius;
  };
  const auto near = [&](double p, double q) { return std::abs(p - q) <= rounding; };
  const auto shape = [&](const Superquadric& p, const Superquadric& q) {
    return p.half_axes == q.half_axes && p.blockiness == q.blockiness &&
           std::equal(p.quaternion.begin(), p.quaternion.end(), q.quaternion.begin(), near);
  };
  return a.step == b.step &&
         std::equal(a.particles.begin(), a.particles.end(), b.particles.begin(), b.particles.end(),
                    particle) &&
         std::equal(a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(), shape);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Outcome whole = read(TextLines(text, "dump"), size);
  for (const std::size_t piece : {std::size_t{7}, std::size_t{64}}) {
    const Outcome pieces = read_in_pieces(text, piece);
    require(pieces.error == whole.error, "the error does not depend on the pieces");
    require(pieces.record.has_value() == whole.record.has_value(), "nor whether there is one");
    require(!whole.record || same(*pieces.record, *whole.record, 0), "nor the record");
  }
  if (!whole.record) return 0;
  require_promises(*whole.record, size);
  const std::string text_again = written(*whole.record);
  const Outcome again = read(TextLines(std::string_view(text_again), "again"), text_again.size());
  require(again.record && same(*again.record, *whole.record, 1e-15), "a record written out is read back");
  return 0;
}
