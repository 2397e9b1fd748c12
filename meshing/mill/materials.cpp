// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/materials.hpp"

#include <map>

namespace millfoam::meshing {
namespace {

const std::map<std::string, Material>& materials() {
  static const std::map<std::string, Material> table{
      {"glass", {2700, 2 * 26.42e9 * (1 + 0.23), 0.23}},
      {"aluminium", {2700, 70e9, 0.33}},
      {"HDPE", {950, 1.0e9, 0.42}},
      {"nylon", {1150, 2.8e9, 0.39}},
      {"perspex", {1190, 3.2e9, 0.37}},
  };
  return table;
}

const std::map<std::string, Contact>& contacts() {
  static const std::map<std::string, Contact> table{
      {"glass-glass", {0.8, 0.94, 0.01}},    {"glass-aluminium", {0.85, 0.306, 0.01}},
      {"glass-HDPE", {0.703, 0.287, 0.01}},  {"glass-nylon", {0.279, 0.532, 0.01}},
      {"glass-perspex", {0.5, 0.424, 0.01}},
  };
  return table;
}

template <typename Table>
std::vector<std::string> names(const Table& table) {
  std::vector<std::string> found;
  found.reserve(table.size());
  for (const auto& entry : table) found.push_back(entry.first);
  return found;
}

}  // namespace

std::vector<std::string> material_names() {
  return names(materials());
}

std::vector<std::string> contact_names() {
  return names(contacts());
}

Material named_material(const std::string& name) {
  return materials().at(name);
}

Contact named_contact(const std::string& name) {
  return contacts().at(name);
}

}  // namespace millfoam::meshing
