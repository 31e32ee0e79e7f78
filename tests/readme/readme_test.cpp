// SPDX-License-Identifier: MIT
// The README and the documents agree with the program: generated pages, links, and every command shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;
using test::run_command;
using test::text_of;

const std::string root = MURO_TEST_SOURCE_DIR "/";
const std::string environment = "MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ";

/// Returns the pages in Markdown, relative to the root.
std::vector<std::string> pages() {
  std::vector<std::string> all = {"README.md", "CONTRIBUTING.md", "sdk/README.md"};
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(root + "docs"))
    if (e.path().extension() == ".md") all.push_back(fs::relative(e.path(), root).string());
  for (const fs::directory_entry& e : fs::directory_iterator(root + "examples"))
    if (fs::exists(e.path() / "README.md")) all.push_back("examples/" + e.path().filename().string() + "/README.md");
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(root + "plugins"))
    if (e.path().filename() == "README.md") all.push_back(fs::relative(e.path(), root).string());
  std::sort(all.begin(), all.end());
  return all;
}

/// Returns the shell commands of a page: lines that begin with the program, and blocks marked `sh`.
std::vector<std::string> commands_of(const std::string& page) {
  std::vector<std::string> all;
  std::istringstream text(text_of(root + page));
  bool in_block = false;
  for (std::string line; std::getline(text, line);) {
    if (in_block && line == "```") {
      in_block = false;
    } else if (in_block) {
      all.back() += line + "\n";
    } else if (line == "```sh") {
      in_block = true;
      all.emplace_back();
    } else if (line.starts_with("    build/bin/muro ")) {
      all.push_back(line.substr(4));
    }
  }
  return all;
}

std::vector<std::string> pages_with_commands() {
  std::vector<std::string> all;
  for (const std::string& page : pages())
    if (!commands_of(page).empty()) all.push_back(page);
  return all;
}

/// Returns the command in the form for a test: for a short time, at any speed, with a window on a virtual display.
std::string shortened(std::string command) {
  command = std::regex_replace(command, std::regex(R"( (--duration|--speed) [^ \n]+)"), "");
  command = std::regex_replace(command, std::regex(R"(build/bin/muro (run|compare) )"), "$& --duration 0.5 ");
  command = std::regex_replace(command, std::regex("\nwait\n"), "\nwait $$!\n");  // its exit code counts
  if (command.find(" --view") != std::string::npos)
    command = std::regex_replace(command, std::regex("^build/bin/muro "), "xvfb-run -a build/bin/muro ");
  return command;
}

/// A folder that looks like the root of the repository after a build. Files that commands write stay in this folder.
class Checkout {
 public:
  Checkout() {
    for (const fs::directory_entry& e : fs::directory_iterator(root))
      if (e.path().filename() != "build" && e.path().filename() != "out")
        fs::create_symlink(e.path(), folder_.path(e.path().filename().string()));
    fs::create_directories(folder_.path("build/bin"));
    fs::create_directories(folder_.path("out"));
    fs::create_symlink(MURO_PROGRAM, folder_.path("build/bin/muro"));
  }
  test::CommandResult run(const std::string& commands) const {
    const std::string script = folder_.file("commands.sh", "set -e\ncd " + folder_.path("") + "\n" + commands + "\n");
    return run_command(environment + "sh " + script);
  }

 private:
  test::ScratchFolder folder_;
};

class Commands : public ::testing::TestWithParam<std::string> {};

TEST_P(Commands, OfThisPageWork) {
  const Checkout checkout;
  for (const std::string& command : commands_of(GetParam())) {
    const auto result = checkout.run(shortened(command));
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  }
}

std::string name_of(const ::testing::TestParamInfo<std::string>& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]+"), "_");
}
INSTANTIATE_TEST_SUITE_P(Pages, Commands, ::testing::Values("README.md"), name_of);
INSTANTIATE_TEST_SUITE_P(SlowPages, Commands, ::testing::ValuesIn(pages_with_commands()), name_of);

TEST(Documents, GeneratedPagesAreWhatTheProgramPrints) {
  for (const auto& [page, command] : {std::pair("docs/reference/plugins.md", "plugins list --markdown"),
                                      std::pair("docs/reference/properties.md", "properties --markdown")}) {
    const auto printed = run_command(environment + MURO_PROGRAM + " " + command);
    EXPECT_EQ(printed.exit_code, 0);
    EXPECT_EQ(text_of(root + page), printed.output) << "write it again: build/bin/muro " << command << " >" << page;
  }
}

TEST(Documents, PropertiesAreThoseOfTheVocabulary) {
  const std::string listed = run_command(environment + MURO_PROGRAM + " properties").output;
  std::string vocabulary;
  for (const auto& entry : fs::directory_iterator(root + "sdk/muro/vocabulary")) vocabulary += text_of(entry.path());
  const std::regex key(R"re(inline constexpr Key<[^>]+> \w+\{\s*"([^"]+)")re");
  int keys = 0;
  for (auto it = std::sregex_iterator(vocabulary.begin(), vocabulary.end(), key); it != std::sregex_iterator(); ++it) {
    ++keys;
    EXPECT_NE(listed.find("\n  " + (*it)[1].str() + " "), std::string::npos) << (*it)[1].str();
  }
  int lines = 0;
  for (std::size_t at = 0; (at = listed.find("\n  ", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, keys) << "and no other, beside titles";
}

TEST(Documents, TheGlossaryIsSortedAndHasEachTermOnce) {
  std::istringstream text(text_of(root + "docs/reference/glossary.md"));
  std::string before;
  int terms = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("| ") || line.starts_with("| term |")) continue;
    std::string term = line.substr(2, line.find(" | ", 2) - 2);
    std::erase_if(term, [](char c) { return c == '`' || c == '*'; });
    for (char& c : term) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    EXPECT_LT(before, term);
    before = term;
    ++terms;
  }
  EXPECT_GT(terms, 100);
}

TEST(Documents, TheSdksPageListsEachHeader) {
  const std::string page = text_of(root + "sdk/README.md");
  for (const auto& entry : fs::recursive_directory_iterator(root + "sdk/muro")) {
    const std::string header = entry.path().lexically_relative(root + "sdk").string();
    if (!entry.is_regular_file() || header.find("/detail/") != std::string::npos) continue;
    EXPECT_NE(page.find("(" + header + ")"), std::string::npos) << header;
  }
}

/// Returns the anchors of a page's headings, as GitHub makes them.
std::set<std::string> anchors_of(const std::string& page) {
  std::set<std::string> anchors;
  std::istringstream text(text_of(root + page));
  bool is_code = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (is_code || !line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# ")))
      if (c == ' ' || c == '-')
        anchor += '-';
      else if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c < 0)
        anchor += char(std::tolower(static_cast<unsigned char>(c)));
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Documents, EveryHeadingTheyLinkToExists) {
  const std::regex link(R"re(\]\(([^)#:\s]*)#([^)\s]+)\))re");
  for (const std::string& page : pages()) {
    const std::string text = text_of(root + page);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator(); ++it) {
      const std::string file = (*it)[1].str();
      const std::string target =
          file.empty() ? page : (fs::path(page).parent_path() / file).lexically_normal().string();
      if (!target.ends_with(".md")) continue;
      EXPECT_TRUE(anchors_of(target).contains((*it)[2].str())) << page << ": " << (*it)[0].str();
    }
  }
}

TEST(Documents, EveryFileTheyLinkToExists) {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  for (const std::string& page : pages()) {
    std::string text = text_of(root + page);
    ASSERT_FALSE(text.empty()) << page;
    // a lambda in an example is not a link
    for (std::size_t begin = 0; (begin = text.find("```", begin)) != std::string::npos;)
      text.erase(begin, text.find("```", begin + 3) + 3 - begin);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator(); ++it) {
      const auto target = (fs::path(root + page).parent_path() / (*it)[1].str()).lexically_normal();
      EXPECT_TRUE(fs::exists(target)) << page << " links to " << (*it)[1].str();
    }
  }
}

TEST(Documents, TheScenarioOfTheReadmeIsTheUrbanExample) {
  const auto one_line = [](std::string text) {
    std::erase(text, '\n');
    return text;
  };
  const std::string readme = text_of(root + "README.md");
  const std::size_t begin = readme.find("```yaml\n") + 8;
  const std::string shown = one_line(readme.substr(begin, readme.find("```", begin) - begin));
  EXPECT_NE(one_line(text_of(root + "examples/urban/urban.yaml")).find(shown.substr(shown.find("robots:"))),
            std::string::npos);
}

}  // namespace
}  // namespace muro
