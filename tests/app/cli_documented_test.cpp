// What docs/command-line.md quotes of the program is what the program says.
#include "cli.h"

#include "dynamics/event.h"

#include <gmock/gmock.h>

namespace lamella {
namespace {

using testing::HasSubstr;

/// "$ lamella ..." and the lines that follow it.
struct Sample {
  std::string command, said;
};

std::string document(const std::string& name = "command-line") {
  return text_of(LAMELLA_SOURCE_DIR "/docs/" + name + ".md");
}

std::vector<Sample> samples() {
  std::vector<Sample> all;
  std::istringstream lines(document());
  bool in_block = false, in_sample = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      in_block = !in_block;
      in_sample = false;
    } else if (in_block && line.starts_with("$ lamella ")) {
      all.push_back({line.substr(10), ""});
      in_sample = true;
    } else if (in_sample) {
      all.back().said += line + "\n";
    }
  }
  return all;
}

TEST_F(Cli, says_what_the_documentation_quotes) {
  ASSERT_EQ(call(quick({"-o", "oblate"})).code, 0);
  fs::create_directory(work() / "notes");
  write(work() / "notes" / "today.txt", "");
  const std::vector<Sample> all = samples();
  EXPECT_GE(all.size(), 8u);
  for (const Sample& sample : all) {
    const Result result = call(words(sample.command));
    EXPECT_EQ(result.out + result.err, sample.said) << "lamella " << sample.command;
  }
  std::size_t quoted = 0;
  std::istringstream lines(document());
  for (std::string line; std::getline(lines, line);) quoted += line.starts_with("lamella: ");
  std::size_t said = 0;
  for (const Sample& sample : all) said += std::size_t(std::ranges::count(sample.said, '\n'));
  EXPECT_EQ(quoted, said) << "a message without the command that it answers";
}

TEST_F(Cli, says_what_the_documentation_quotes_of_scenes) {
  const std::string format = document("scene-format"), place = "\nvesicle.toml:7: ";
  const std::size_t begin = format.find(place) + 1, end = format.find("\n", begin),
                    left_out = format.find("...", begin);
  ASSERT_TRUE(begin > 0 && left_out < end);
  EXPECT_EQ(format.find(place, end), format.npos) << "another one";
  write(work() / "vesicle.toml",
        "title = \"mine\"\n\n[grid]\nnodes = 32\n\n[shape]\nsemi_axs = 0.7\n");
  EXPECT_THAT(
      call(words("run vesicle.toml")).err,
      testing::AllOf(testing::StartsWith("lamella: " + format.substr(begin, left_out - begin)),
                     testing::EndsWith(format.substr(left_out + 3, end - left_out - 2))));
}

TEST_F(Cli, tells_events_as_the_documentation_does) {
  const Event event{.kind = Event::Kind::fission,
                    .time = 4.2141e-5,
                    .place = {0, 0, -0.447},
                    .size = 0.0372,
                    .components_before = 1,
                    .components_after = 3,
                    .area_before = 1,
                    .area_cut = 0.961,
                    .energy_before = 162.058,
                    .energy_after = 148.639};
  EXPECT_THAT(document(), HasSubstr("\n" + to_text(event, 2. / 64) + "\n"));
}

} // namespace
} // namespace lamella
