// SPDX-License-Identifier: BSD-3-Clause
// The ini reader: what it takes, and that every mistake is told with its line.
#include "app/ini.hpp"

#include "trime/core/error.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

std::string value_of(const IniDocument& document, const char* section, const char* key) {
  const IniEntry* entry = document.find(section, key);
  return entry ? entry->value : "(absent)";
}

TEST(Ini, ReadsSectionsKeysAndCommentsAnywhere) {
  Diagnostics problems("a.ini");
  const IniDocument document = parse_ini("\xEF\xBB\xBF; a comment\r\n[domain]# the container\r\n x_min=0 ; left\r\n"
                                         "x_max =  2.5\t# right\n\n[shape.hole]\ncenter = 0.5 0.5\nlast = x=y",
                                         problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  EXPECT_EQ(value_of(document, "domain", "x_min"), "0");
  EXPECT_EQ(value_of(document, "domain", "x_max"), "2.5");
  EXPECT_EQ(value_of(document, "shape.hole", "center"), "0.5 0.5");
  EXPECT_EQ(value_of(document, "shape.hole", "last"), "x=y");
  EXPECT_EQ(document.find("shape.hole", "center")->line, 7);
  EXPECT_EQ(document.find("shape", "center"), nullptr);
}

TEST(Ini, ACommentStartsAfterABlankOnly) {
  Diagnostics problems("a.ini");
  const IniDocument document = parse_ini("[a]\nfile = a#b;c.xy ;d\n  # e = 1\n\t; f = 1\n", problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  EXPECT_EQ(value_of(document, "a", "file"), "a#b;c.xy");
  EXPECT_EQ(document.entries.size(), 1u);
}

TEST(Ini, TellsEveryMistakeWithItsLine) {
  Diagnostics problems("a.ini");
  parse_ini("early = 1\n[domain\nlost = 1\n[meshing]\nseed = 1\njunk\nseed = 2\npoints =\n= 3\n[meshing]\n[]\n",
            problems);
  EXPECT_EQ(problems.text(), "a.ini:1: the key 'early' comes before the first [section]\n"
                             "a.ini:2: expected a section such as [domain], found '[domain'\n"
                             "a.ini:6: expected 'key = value' or '[section]', found 'junk'\n"
                             "a.ini:7: the key 'seed' is set twice in [meshing], first on line 5; keep one of them\n"
                             "a.ini:8: the key 'points' has no value; write one, or remove the line\n"
                             "a.ini:9: '' is not a valid name of a key: use letters, digits, '_' and '-'\n"
                             "a.ini:10: the section [meshing] occurs twice, first on line 4; put its keys together\n"
                             "a.ini:11: expected a section such as [domain], found '[]'");
}

TEST(Ini, SurvivesBinaryInputWithAShortMessage) {
  std::string text;
  for (int k = 0; k < 20000; ++k)
    text += static_cast<char>(k * 7919 % 251);
  Diagnostics problems("a.ini");
  parse_ini(text, problems);
  ASSERT_FALSE(problems.empty());
  EXPECT_LT(problems.text().size(), 5000u);
  for (const char c : problems.text())
    EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 32);
}

TEST(Ini, EmptyTextIsAnEmptyDocument) {
  Diagnostics problems("a.ini");
  EXPECT_TRUE(parse_ini("", problems).entries.empty());
  EXPECT_TRUE(parse_ini("\n\n ; nothing", problems).entries.empty());
  EXPECT_TRUE(problems.empty());
  EXPECT_NO_THROW(problems.throw_if_any());
}

TEST(Ini, OverrideReplacesAddsAndRemoves) {
  Diagnostics problems("a.ini");
  IniDocument document = parse_ini("[meshing]\npoints = 10\nseed = 3\n", problems);
  apply_override(document, "meshing.points = 15", problems);
  apply_override(document, "meshing.points = 20", problems); // the last one holds
  apply_override(document, "shape.hole.radius=0.2", problems);
  apply_override(document, "meshing.seed=", problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  EXPECT_EQ(value_of(document, "meshing", "points"), "20");
  EXPECT_EQ(document.find("meshing", "points")->line, command_line_origin);
  EXPECT_EQ(value_of(document, "shape.hole", "radius"), "0.2");
  EXPECT_EQ(value_of(document, "meshing", "seed"), "(absent)");
}

TEST(Ini, BadOverridesNameTheCommandLine) {
  Diagnostics problems("a.ini");
  IniDocument document;
  for (const char* text : {"points", "points=3", ".points=3", "meshing.=3", ""})
    apply_override(document, text, problems);
  EXPECT_EQ(problems.size(), 5u);
  EXPECT_EQ(problems.text().rfind("command line: expected section.key=value, found 'points'", 0), 0u);
  EXPECT_THROW(problems.throw_if_any(), ConfigError);
}

TEST(Ini, DiagnosticsAreSortedByPlace) {
  Diagnostics problems("a.ini");
  problems.add(command_line_origin, "third");
  problems.add(whole_file, "second");
  problems.add(4, "first");
  EXPECT_EQ(problems.text(), "a.ini:4: first\na.ini: second\ncommand line: third");
  EXPECT_EQ(problems.text(1), "a.ini:4: first\na.ini: 2 more errors");
}

/// Once each pair of lines made a message of its own: 25000 lines took 20 GB.
TEST(Ini, MessagesDoNotGrowAsASquare) {
  constexpr int count = 2000;
  std::string text;
  for (int k = 0; k < count; ++k)
    text += "[meshing]\nseed = 1\n";
  Diagnostics problems("a.ini");
  parse_ini(text, problems);
  EXPECT_GE(problems.size(), std::size_t{2 * count - 2}); // each section and key but the first
  EXPECT_LE(problems.size(), std::size_t{32 * count});
  EXPECT_NE(problems.text().find("a.ini:3: the section [meshing] occurs twice, first on line 1"), std::string::npos);
}

} // namespace
} // namespace trime::app
