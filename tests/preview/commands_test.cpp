// SPDX-License-Identifier: BSD-3-Clause
// The table of commands: each makes another state without changing the given one; commands.md has all.
#include "app/preview/commands.h"

#include <sstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/preview/two_models.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Json = nlohmann::json;

TEST(PreviewCommands, MakeAnotherStateAndLeaveTheOneTheyGet) {
  const TemporaryFolder folder;
  ReadOptions reading;
  reading.model.all = true;
  PreviewState state;
  const ShownMolecule molecule(read_structure(folder.file("two.pdb", kTwoModels), reading), {}, {}, state);
  state.camera = molecule.overview(state);
  ViewCache pictures(make_cpu_preview_renderer());
  pictures.take(state, molecule, Renewal::frame, true);
  Exporter exporter{folder.path(), {}};
  const EditHistory history;
  const auto told = [&](const PreviewState& one) {
    return get_state(CommandReader(Json::object()), {one, state, history, molecule, pictures, exporter});
  };
  const Json before = told(state);
  const std::vector<std::pair<const char*, Renewal>> kCommands{
      {R"({"command":"orbit","dx":0.1,"dy":0.2})", Renewal::nothing},
      {R"({"command":"key"})", Renewal::nothing},
      {R"({"command":"play"})", Renewal::nothing},
      {R"({"command":"set","key":"look.silhouettes","value":2})", Renewal::legend},
      {R"({"command":"set","key":"surface.patches","value":"element C"})", Renewal::colors},
      {R"({"command":"resize","width":50,"height":40})", Renewal::legend},
      {R"({"command":"set","key":"surface.probe","value":2})", Renewal::legend},
      {R"({"command":"add","key":"surface.clip","value":"x<1"})", Renewal::cuts},
      {R"({"command":"take_away","selection":"name O"})", Renewal::colors},
      {R"({"command":"add","key":"surface.color","value":"name O=red"})", Renewal::colors},
      {R"({"command":"add","key":"figure.sticks","value":"name O"})", Renewal::shapes},
      {R"({"command":"frame","index":1})", Renewal::frame},
  };
  const Surroundings around{state, state, history, molecule, pictures, exporter};
  for (const auto& [text, renewal] : kCommands) {
    const Json command = Json::parse(text);
    const CommandReader reader(command);
    Reducer* const reduce = std::get<Reducer*>(row_of(reader).run);
    const Outcome one = reduce(reader, state, around), again = reduce(reader, state, around);
    EXPECT_EQ(one.renewal, renewal) << text;
    EXPECT_EQ(told(one.state), told(again.state)) << text;
    EXPECT_NE(told(one.state), before) << text;
    EXPECT_EQ(told(state), before) << text;
  }
}

TEST(PreviewCommands, AreInTheirTableOfCommands) {
  const std::string page = read_bytes(test_file("../app/preview/commands.md"));
  std::string words;
  try {
    row_of(CommandReader(Json{{"command", "fly"}}));
  } catch (const RequestError& error) {
    words = error.what();
  }
  std::istringstream list(words.substr(words.find("the commands are ") + 17));
  std::size_t count = 0;
  for (std::string word; std::getline(list >> std::ws, word, ','); ++count) {
    EXPECT_NE(page.find("`" + word + "`"), std::string::npos) << word;
    const Json command{{"command", word}};
    for (const std::string_view key : row_of(CommandReader(command)).keys)
      EXPECT_NE(page.find("`" + std::string(key) + "`"), std::string::npos) << word << " " << key;
  }
  EXPECT_GT(count, 35u);
  // Messages about words of former versions name their successors.
  try {
    row_of(CommandReader(Json{{"command", "probe"}}));
    ADD_FAILURE();
  } catch (const RequestError& error) {
    EXPECT_STREQ(error.what(), "'probe' is no command any more; use set with the key surface.probe");
  }
}

}  // namespace
}  // namespace meniscus::test
