// SPDX-License-Identifier: BSD-3-Clause
// Reads the assemblies of mmCIF, which apply products of operators to chains (label_asym_id).

#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/math/rigid_motion.h"
#include "core/structure/assembly.h"
#include "core/structure/formats/cif_document.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/plausibility.h"

namespace meniscus {
namespace {

namespace cif = gemmi::cif;

constexpr std::size_t kMostMotions = 1'000'000;  // the greatest number for all assemblies of a file

std::map<std::string, RigidMotion> operators_of(const TextFile& file, cif::Block& block) {
  std::vector<std::string> tags{"id"};
  for (const char row : {'1', '2', '3'}) {
    for (const char column : {'1', '2', '3'}) tags.push_back(fmt::format("matrix[{}][{}]", row, column));
    tags.push_back(fmt::format("vector[{}]", row));
  }
  std::map<std::string, RigidMotion> operators;
  for (const cif::Table::Row row : block.find("_pdbx_struct_oper_list.", tags)) {
    std::array<std::array<double, 4>, 3> matrix{};
    for (std::size_t n = 0; n < 12; ++n) {
      double& number = matrix[n / 4][n % 4];
      if (!parse_number(row[n + 1], number) || std::abs(number) > kLargestCoordinate)
        throw InputError(
            file.path, 0,
            "operator {} of _pdbx_struct_oper_list has {} for {}, not a number of at most {}; correct the matrix",
            in_quotes(row.str(0)), in_quotes(row[n + 1]), tags[n + 1], kLargestCoordinate);
    }
    operators.emplace(row.str(0), rigid_motion(matrix, file.path, 0));
  }
  return operators;
}

const RigidMotion& operator_named(const std::string& name, const std::map<std::string, RigidMotion>& operators,
                                  const std::string& file) {
  const auto found = operators.find(name);
  if (found != operators.end()) return found->second;
  throw InputError(file, 0, "an assembly asks for operator {}, which _pdbx_struct_oper_list does not hold",
                   in_quotes(name));
}

/// Returns all products of an expression. Products that differ only in the last factor follow each other. Common
/// factors are multiplied once.
std::vector<RigidMotion> products_of(std::string_view expression, const std::map<std::string, RigidMotion>& operators,
                                     const std::string& file) {
  std::vector<RigidMotion> products(1);
  for (const std::vector<std::string>& names : operator_factors(expression, file)) {
    std::vector<const RigidMotion*> factors;
    for (const std::string& name : names) factors.push_back(&operator_named(name, operators, file));
    std::vector<RigidMotion> longer;
    longer.reserve(products.size() * factors.size());
    for (const RigidMotion& product : products) {
      for (const RigidMotion* factor : factors) longer.push_back(product * *factor);
    }
    products = std::move(longer);
  }
  return products;
}

std::vector<std::string> split_at_commas(const std::string& list) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : list + ",") {
    if (c == ',') {
      if (!name.empty()) names.push_back(std::move(name));
      name.clear();
    } else if (c != ' ' && c != '\n' && c != '\t') {
      name += c;
    }
  }
  return names;
}

std::map<std::string, std::string> descriptions_of(cif::Block& block) {
  std::map<std::string, std::string> descriptions;
  for (const cif::Table::Row row : block.find("_pdbx_struct_assembly.", {"id", "?oligomeric_details", "?details"})) {
    const std::size_t column = row.has2(1) ? 1 : 2;
    if (row.has2(column)) descriptions[row.str(0)] = row.str(static_cast<int>(column));
  }
  return descriptions;
}

}  // namespace

std::vector<Assembly> read_mmcif_assemblies(const TextFile& file) {
  cif::Document document = parse_cif(file, [](cif::Block&, std::size_t) {});
  std::vector<Assembly> assemblies;
  std::size_t motions = 0;
  for (cif::Block& block : document.blocks) {
    const std::map<std::string, RigidMotion> operators = operators_of(file, block);
    const std::map<std::string, std::string> descriptions = descriptions_of(block);
    for (const cif::Table::Row row :
         block.find("_pdbx_struct_assembly_gen.", {"assembly_id", "oper_expression", "asym_id_list"})) {
      if (assemblies.empty() || assemblies.back().id != row.str(0)) {
        const auto description = descriptions.find(row.str(0));
        assemblies.push_back({row.str(0), description == descriptions.end() ? std::string() : description->second, {}});
      }
      AssemblyPart& part = assemblies.back().parts.emplace_back();
      part.chains = split_at_commas(row.str(2));
      part.motions = products_of(row.str(1), operators, file.path);
      motions += part.motions.size();
      if (motions > kMostMotions)
        throw CapacityError("{}: its assemblies have more than {} operators, more than this program reads", file.path,
                            with_thousands(kMostMotions));
    }
  }
  return assemblies;
}

}  // namespace meniscus
