// SPDX-License-Identifier: BSD-3-Clause
// Messages name options as each door spells them, and only those that the message itself names.
#include "core/base/text.h"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

std::string as_in_python(std::string_view option) { return "<" + std::string(option) + ">"; }

TEST(Message, OptionsAreSpelledAsTheDoorDoes) {
  EXPECT_EQ(message("@color rmsf@ needs frames; add @frames all@"), "--color rmsf needs frames; add --frames all");
  EXPECT_EQ(message("@zoom-to {}@: none of {}", "'chain Q'", 5), "--zoom-to 'chain Q': none of 5");
  EXPECT_EQ(with_options("no option"), "no option");
}

TEST(Message, TextsThatArePutInAreNotSearched) {
  EXPECT_EQ(message("{}: leave @probe@ out", "a@color@b.pdb"), "a@color@b.pdb: leave --probe out");
}

TEST(Message, AnotherDoorSpellsTheWholeOption) {
  const std::string usual = option_name("probe");
  spell_options(as_in_python);
  const std::string said = message("add @frames {}@, or {}", "all", 1);
  spell_options([](std::string_view option) { return "--" + std::string(option); });
  EXPECT_EQ(said, "add <frames all>, or 1");
  EXPECT_EQ(option_name("probe"), usual);
}

}  // namespace
}  // namespace meniscus
