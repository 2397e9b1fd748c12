// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_columns.hpp"

#include <algorithm>

#include "averaging/dumps/dump_error.hpp"
#include "averaging/dumps/text_lines.hpp"

namespace millfoam::averaging {

namespace {

struct Name {
  std::string_view text;
  int quantity;
};

/// LIGGGHTS calls the exponents of a superquadric blockiness. Its quaternions begin with the scalar part.
constexpr std::array<Name, 14> fixed_names{{{"id", quantity_id},
                                            {"vx", quantity_velocity},
                                            {"vy", quantity_velocity + 1},
                                            {"vz", quantity_velocity + 2},
                                            {"radius", quantity_radius},
                                            {"shapex", quantity_half_axes},
                                            {"shapey", quantity_half_axes + 1},
                                            {"shapez", quantity_half_axes + 2},
                                            {"blockiness1", quantity_blockiness},
                                            {"blockiness2", quantity_blockiness + 1},
                                            {"quat1", quantity_quaternion},
                                            {"quat2", quantity_quaternion + 1},
                                            {"quat3", quantity_quaternion + 2},
                                            {"quat4", quantity_quaternion + 3}}};

/// Kinds of position: in the box, scaled by the box, unwrapped through periodic boundaries, both.
constexpr std::array<std::string_view, 4> position_kinds{"", "s", "u", "su"};

/// Which kind of position a name is, or the number of kinds when it is none.
std::size_t position_kind(std::string_view name) {
  if (name.empty() || name[0] < 'x' || name[0] > 'z') return position_kinds.size();
  const auto* const kind = std::find(position_kinds.begin(), position_kinds.end(), name.substr(1));
  return static_cast<std::size_t>(kind - position_kinds.begin());
}

int quantity_of(std::string_view name) {
  if (position_kind(name) < position_kinds.size()) return quantity_position + (name[0] - 'x');
  const auto* const found = std::find_if(fixed_names.begin(), fixed_names.end(),
                                         [&](const Name& known) { return known.text == name; });
  return found == fixed_names.end() ? -1 : found->quantity;
}

std::string name_of(int quantity) {
  if (quantity >= quantity_position && quantity < quantity_velocity) {
    return std::string(1, static_cast<char>('x' + quantity - quantity_position));
  }
  const auto* const found = std::find_if(fixed_names.begin(), fixed_names.end(),
                                         [&](const Name& known) { return known.quantity == quantity; });
  return std::string(found->text);
}

class Matcher {
 public:
  Matcher(std::string_view names, const std::string& place) : place_(place) { columns_.names = names; }

  DumpColumns match() {
    std::string_view rest = columns_.names;
    for (std::string_view name = take_word(rest); !name.empty(); name = take_word(rest)) add(name);
    columns_.shapes =
        has_any(quantity_half_axes, 3) || has_any(quantity_blockiness, 2) || has_any(quantity_quaternion, 4);
    require(quantity_id, 1, "");
    require(quantity_position, 3, "");
    require(quantity_velocity, 3, "");
    if (columns_.shapes) {
      const char* const why = ", but other columns of a superquadric are there";
      require(quantity_half_axes, 3, why);
      require(quantity_quaternion, 4, why);
      if (has_any(quantity_blockiness, 2)) require(quantity_blockiness, 2, why);
    } else {
      require(quantity_radius, 1, "");
    }
    return std::move(columns_);
  }

 private:
  void add(std::string_view name) {
    if (name == "roundness1" || name == "roundness2") {
      refuse("column '" + std::string(name) + "' is not known: dump 'blockiness1 blockiness2' instead");
    }
    const int quantity = quantity_of(name);
    columns_.quantity.push_back(quantity);
    if (quantity < 0) return;
    std::string& earlier = columns_.name[static_cast<std::size_t>(quantity)];
    const std::size_t kind = position_kind(name);
    if (kind < position_kinds.size()) {
      if (!position_.empty() && kind != position_kind(position_)) {
        refuse("columns '" + std::string(position_) + "' and '" + std::string(name) +
               "' are two kinds of position, expected one of 'x y z', 'xs ys zs', 'xu yu zu'");
      }
      if (position_.empty()) position_ = name;
      columns_.scaled = name.size() > 1 && name[1] == 's';
    }
    if (!earlier.empty()) refuse("column '" + std::string(name) + "' appears twice");
    earlier = name;
  }

  bool has_any(int quantity, int count) const {
    const auto* const first = columns_.name.begin() + quantity;
    return std::any_of(first, first + count, [](const std::string& name) { return !name.empty(); });
  }

  void require(int quantity, int count, const char* why) const {
    for (int q = quantity; q < quantity + count; ++q) {
      if (!columns_.name[static_cast<std::size_t>(q)].empty()) continue;
      const std::string kind(position_kind(position_) < position_kinds.size() && q < quantity_velocity &&
                                     q > 0
                                 ? position_.substr(1)
                                 : "");
      refuse("column '" + name_of(q) + kind + "' is missing" + why);
    }
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw DumpError(place_ + reason + "; the columns are '" + columns_.names + "'");
  }

  const std::string& place_;
  DumpColumns columns_;
  std::string_view position_;  ///< the first column of a position
};

}  // namespace

DumpColumns find_columns(std::string_view names, const std::string& place) {
  return Matcher(names, place).match();
}

}  // namespace millfoam::averaging
