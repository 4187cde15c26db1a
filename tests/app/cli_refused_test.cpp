// Command lines and scenes that the program refuses.
#include "cli.h"

#include <gmock/gmock.h>

namespace lamella {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

struct BadCall {
  const char* name;
  Arguments arguments;
  const char* part;       ///< of the message
  const char* scene = ""; ///< text of bad.toml
};

void PrintTo(const BadCall& bad, std::ostream* out) { *out << bad.name; }

const std::vector<BadCall> bad_calls{
    {"Command", {"rnu", "sphere"}, "did you mean \"run\"?"},
    {"SceneAsCommand", {"sphere"}, "allowed: run, render, figure"},
    {"NoScene", {"run"}, "scene is required"},
    {"Option", {"run", "sphere", "--treads", "2"}, "did you mean \"--threads\"?"},
    {"OptionBeforeTheCommand", {"--treads"}, "--treads: no such option"},
    {"TwoScenes", {"run", "sphere", "torus"}, "\"torus\" is one argument too many"},
    {"NoThreads", {"run", "sphere", "--threads", "0"}, "--threads"},
    {"ThreadsInWords", {"run", "sphere", "--threads", "all"}, "--threads"},
    {"Backend", {"run", "sphere", "--backend", "metal"}, "--backend: metal"},
    {"NoFolder", {"run", "sphere", "-o"}, "--output"},
    {"EmptyFolder", {"run", "sphere", "-o", ""}, "--output: the name is empty"},
    {"SetNothing", {"run", "sphere", "--set"}, "--set"},
    {"SetSection", {"run", "sphere", "--set", "gird.nodes=64"}, "--set gird.nodes=64: [gird]"},
    {"SetKey", {"run", "sphere", "--set", "grid.nods=64"}, "did you mean \"nodes\"?"},
    {"SetWithoutValue", {"run", "sphere", "--set", "grid.nodes"}, "--set grid.nodes: no key and"},
    {"SetRange", {"run", "sphere", "--set", "grid.nodes=60"}, "--set grid.nodes=60: [grid] nodes"},
    {"BuiltinName", {"run", "fig3_oblat"}, "did you mean \"fig3_oblate\"?"},
    {"EmptyName", {"run", ""}, "neither a file nor a built-in scene"},
    {"EndlessName", {"run", std::string(5000, 'x')}, "too long for the name of a file"},
    {"NameInTwoLines", {"run", "sph\nere\033[31m"}, "sph?ere?[31m"},
    {"BuiltinAsFile", {"run", "sphere.toml"}, "no such file; the built-in scene is called sphere"},
    {"MissingFile", {"run", "away/bad.toml"}, "away/bad.toml: no such file"},
    {"FileWithoutEnding", {"run", "bad"}, "did you mean \"bad.toml\"?", "[grid]\nnodes = 64\n"},
    {"FolderAsScene", {"run", "."}, "this is a folder"},
    {"Toml", {"run", "bad.toml"}, "bad.toml:1: this is not TOML", "[grid\n"},
    {"Binary",
     {"run", "bad.toml"},
     "bad.toml:1",
     "\x7f"
     "ELF\x01\x02"},
    {"EmptyScene", {"run", "bad.toml"}, "the scene is empty", "\n"},
    {"Key", {"run", "bad.toml"}, "bad.toml:2: [grid] nods", "[grid]\nnods = 64\n"},
    {"Text", {"run", "bad.toml"}, "bad.toml:2: [run] end_time", "[run]\nend_time = \"1\"\n"},
    {"Choice", {"run", "bad.toml"}, "did you mean \"oblate\"?", "[shape]\nkind = \"obalte\"\n"},
    {"OutOfTheBox", {"run", "bad.toml"}, "outside the box", "[shape]\nsemi_axis = 3\n"},
    {"BuiltinToShow", {"scenes", "spher"}, "did you mean \"sphere\"?"},
    {"NoRun", {"render"}, "folder is required"},
    {"RunNotThere", {"render", "away"}, "away: no such folder"},
    {"FolderWithoutRun", {"render", "."}, ".: holds no run"},
    {"Width", {"render", ".", "--width", "20"}, "--width: Value 20 not in range"},
};

class Refused : public Cli, public testing::WithParamInterface<BadCall> {};

TEST_P(Refused, with_one_clear_line_and_nothing_written) {
  const BadCall& bad = GetParam();
  if (*bad.scene) write(work() / "bad.toml", bad.scene);
  const std::set<std::string> before = names_in(work());
  const Result result = call(bad.arguments);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, MatchesRegex("lamella: [^\n]+\n"));
  EXPECT_THAT(result.err, HasSubstr(bad.part));
  EXPECT_EQ(names_in(work()), before);
}

INSTANTIATE_TEST_SUITE_P(Calls, Refused, testing::ValuesIn(bad_calls),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace lamella
