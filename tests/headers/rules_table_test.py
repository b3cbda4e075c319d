#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that scripts/rules_table.py reads our numbers and their effects, and that src/rules.md holds them."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "rules_table.py"
MARKS = ("<!-- rules: made by scripts/rules_table.py --write src/rules.md -->", "<!-- end of rules -->")
GOOD = """
namespace trime::sweep {
/// The numbers of the sweeps.
struct SweepRules {
  /// [h] A move shorter than this counts as rest.
  /// With 0.01 sweeps stop | earlier. Not measured.
  static constexpr double still = 0.005;
  /// [1] Two of them. Not measured.
  static constexpr std::array<double, 2> shares{0.1,
                                                0.2}; // both
  static constexpr bool is_free(double h) { return h > still; }
};
} // namespace trime::sweep
"""

MEASURED = GOOD.replace("earlier. Not measured.", "earlier.")
COLUMNS = "number,factor,same_meshes,mean_alpha,largest_alpha,points,time,failed\n"
EFFECTS = "src/rules_effects.csv"


def run(files, *arguments):
    """The finished script on a tree of {path: text}; the tree's page.md after it."""
    with tempfile.TemporaryDirectory() as directory:
        root = pathlib.Path(directory)
        for path, text in files.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        command = [sys.executable, SCRIPT, "--root", root, *(str(root / a) if a == "page.md" else a for a in arguments)]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        page = root / "page.md"
        return done, page.read_text(encoding="utf-8") if page.exists() else ""


class RulesTable(unittest.TestCase):
    def test_reads_name_value_unit_and_reason(self):
        done, _ = run({"src/sweep/rules.hpp": GOOD, "src/sweep/other.hpp": "static constexpr int n = 1;\n"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines(), [
            "## sweep", "", "| name | value | unit | reason | effect |", "|---|---|---|---|---|",
            "| `SweepRules::still` | 0.005 | h | A move shorter than this counts as rest. "
            "With 0.01 sweeps stop \\| earlier. Not measured. |  |",
            "| `SweepRules::shares` | {0.1, 0.2} | 1 | Two of them. Not measured. |  |"])

    def test_says_what_a_number_does(self):
        for lines, effect in (
                (("0.8,6,+0.0000,+0.000,+0.0000,,", "1.25,6,+0.0000,+0.000,+0.0000,,"), "x1.25, x0.8: same meshes"),
                (("0.8,6,+0.0000,+0.000,+0.0000,,", "1.25,4,+0.0012,-0.311,-0.0044,,"),
                 "x1.25: 2 of 6 meshes, mean alpha +0.0012, largest -0.31, points -0.44 %; x0.8: same meshes"),
                (("0.8,6,+0.0000,+0.000,+0.0000,1.31,", "1.25,5,+0.0000,+0.001,+0.0000,0.82,"),
                 "x1.25: 1 of 6 meshes, time x0.82; x0.8: same meshes, time x1.3"),
                (("0.8,3,+0.0100,+0.000,+0.0000,,coast", "1.25,4,+0.0000,+0.000,+0.0000,,coast few"),
                 "x1.25: fails: coast, few, other meshes the same; "
                 "x0.8: fails: coast, 2 of 6 meshes, mean alpha +0.0100")):
            with self.subTest(effect=effect):
                text = COLUMNS + "".join(f"sweep::SweepRules::still,{line}\n" for line in lines)
                done, _ = run({"src/sweep/rules.hpp": MEASURED, EFFECTS: text})
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout.splitlines()[4].split(" | ")[-1], effect + " |")

    def test_wants_to_know_of_every_number_whether_it_is_measured(self):
        line = "sweep::SweepRules::{},1.25,6,+0.0000,+0.000,+0.0000,,\n"
        for header, names, complaint in ((MEASURED, [], "still: no line in src/rules_effects.csv"),
                                         (GOOD, ["still"], "still: its comment says 'Not measured.'"),
                                         (GOOD, ["gone"], "sweep::SweepRules::gone: there is no such number")):
            with self.subTest(complaint=complaint):
                done, _ = run({"src/sweep/rules.hpp": header, EFFECTS: COLUMNS + "".join(map(line.format, names))})
                self.assertEqual(done.returncode, 1)
                self.assertIn(complaint, done.stderr)

    def test_knows_how_many_cases_were_measured(self):
        sys.path.insert(0, str(SCRIPT.parent))
        import measure_rules
        self.assertEqual(len(measure_rules.CASES), measure_rules.rules_table.CASES)

    def test_complains_of_a_number_without_unit_or_reason(self):
        for comment, complaint in (("", "no unit"), ("/// It is small.", "no unit"), ("/// [h]", "no reason")):
            with self.subTest(comment=comment):
                text = "struct XRules {\n" + comment + "\n  static constexpr double x = 1;\n};\n"
                done, _ = run({"src/start/rules.hpp": text})
                self.assertEqual(done.returncode, 1)
                self.assertIn("src/start/rules.hpp:3: x: " + complaint, done.stderr)

    def test_one_comment_does_not_serve_two_numbers(self):
        text = ("struct XRules {\n  /// [h] Why.\n  static constexpr double x = 1;\n"
                "  static constexpr double y = 2;\n};\n")
        done, _ = run({"src/start/rules.hpp": text})
        self.assertEqual(done.returncode, 1)
        self.assertIn(":4: y: no unit", done.stderr)

    def test_warns_of_one_name_for_several_numbers(self):
        done, _ = run({"src/sweep/rules.hpp": GOOD,
                       "src/start/rules.hpp": GOOD.replace("SweepRules", "StartRules").replace("0.005", "0.1")})
        self.assertEqual(done.returncode, 0)
        self.assertIn("still: one name, several numbers", done.stderr)
        self.assertIn("shares: one number twice", done.stderr)

    def test_writes_a_page_and_finds_what_has_changed_since(self):
        page = "before\n" + "\n".join(MARKS) + "\nafter\n"
        files = {"src/sweep/rules.hpp": GOOD, "page.md": page}
        self.assertEqual(run(files, "--check", "page.md")[0].returncode, 1)
        done, written = run(files, "--write", "page.md")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(written.startswith("before\n" + MARKS[0] + "\n## sweep\n"), written)
        self.assertTrue(written.endswith("|\n" + MARKS[1] + "\nafter\n"), written)
        files["page.md"] = written
        self.assertEqual(run(files, "--check", "page.md")[0].returncode, 0)
        files["src/sweep/rules.hpp"] = GOOD.replace("0.005", "0.006")
        done, _ = run(files, "--check", "page.md")
        self.assertEqual(done.returncode, 1)
        self.assertIn("0.006", done.stderr)

    def test_says_that_a_page_has_no_marks(self):
        done, _ = run({"page.md": "nothing\n"}, "--check", "page.md")
        self.assertEqual(done.returncode, 1)
        self.assertIn(MARKS[0], done.stderr)

    def test_our_page_holds_our_numbers(self):
        done = subprocess.run([sys.executable, str(SCRIPT), "--check", str(ROOT / "src" / "rules.md")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
