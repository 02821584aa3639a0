"""Paths that comments and documents name exist, relative links of documents lead somewhere; the rules notice where not."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMENT = {".h": "//", ".cc": "//", ".js": "//", ".py": "#", ".sh": "#", ".cmake": "#", ".txt": "#", ".md": ""}
# What is history, what others wrote, what a fuzzer made, and faults.
LEFT_OUT = ("CHANGELOG.md", "bench/HISTORY.md", "third_party/", "tests/fuzz/corpus/", "tests/mutants/")
FOLDERS = sorted(d.name for d in ROOT.iterdir() if d.is_dir() and not d.name.startswith(("build", ".git", "out")))
PATH = re.compile(r"(?<![\w/.$}*<-])(?:" + "|".join(map(re.escape, FOLDERS)) + r")/[\w./-]*\w(?![\w*{<\[…])")


def files():
    for folder in [ROOT, *(ROOT / name for name in FOLDERS)]:
        for file in sorted(folder.glob("*" if folder == ROOT else "**/*")):
            name = file.relative_to(ROOT).as_posix()
            if file.suffix in COMMENT and file.is_file() and not name.startswith(LEFT_OUT):
                yield name, file.read_text(errors="replace")


def comment(line, begin):
    """What stands after the comment's beginning, which is not that of an address."""
    if not begin:
        return line
    found = re.search(r"(?<!:)" + re.escape(begin) + "(.*)", line)
    return found.group(1) if found else ""


def missing_paths(name, text):
    """Paths from the root, or from the file's folder; a name without .h stands for a header, NAME for any."""
    for number, line in enumerate(text.splitlines(), 1):
        for path in PATH.findall(comment(line, COMMENT[pathlib.Path(name).suffix])):
            places = [ROOT / path, ROOT / (path + ".h"), ROOT / (path + ".cc"), (ROOT / name).parent / path]
            if "NAME" not in path and not any(place.exists() for place in places):
                yield f"{name}:{number}: there is no {path}"


def anchors(text):
    """Those that GitHub gives to headings."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text, flags=re.S), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", h.strip().lower()).replace(" ", "-") for h in headings}


def broken_links(name, text):
    for link in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", text, flags=re.S)):
        if re.match("[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        file = (ROOT / name).parent / path if path else ROOT / name
        if not file.exists():
            yield f"{name}: {link} leads nowhere"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text()):
            yield f"{name}: {link}: the file has no such heading"


def glossary():
    """Of each row its words, and where the code defines them."""
    lines = (ROOT / "doc/glossary.md").read_text().splitlines()
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines if line.startswith("| ")]
    return [(words, where) for words, _, where in cells if words not in ("word", "---")]


def misnamed(words, where):
    """A name is in the file that follows it, or in some header."""
    headers = None
    for names, path in re.findall(r"((?:`[\w:]+`[^`/]*?)+)(?:(?<=, )([\w/]+\.h)|$|;)", where):
        for name in re.findall(r"`([\w:]+)`", names):
            if path:
                texts = [(ROOT / path).read_text()]
            else:
                headers = headers or [text for file, text in files() if file.endswith(".h")]
                texts = headers
            word = re.compile(r"\b" + name.split("::")[-1] + r"\b")
            if not any(word.search(text) for text in texts):
                yield f"{words}: there is no {name} in {path or 'any header'}"


class Documents(unittest.TestCase):
    def test_every_path_in_a_comment_or_document_exists(self):
        found = [problem for name, text in files() for problem in missing_paths(name, text)]
        self.assertEqual(found, [], "\n" + "\n".join(found))
        self.assertGreater(sum(len(PATH.findall(text)) for _, text in files()), 500)

    def test_every_relative_link_leads_somewhere(self):
        documents = [(name, text) for name, text in files() if name.endswith(".md")]
        found = [problem for name, text in documents for problem in broken_links(name, text)]
        self.assertEqual(found, [], "\n" + "\n".join(found))
        self.assertGreater(len(documents), 20)

    def test_the_glossary_has_one_meaning_of_each_word_and_names_what_is_in_the_code(self):
        rows = glossary()
        words = [word.strip() for words, _ in rows for word in words.split(",")]
        self.assertEqual([word for word in set(words) if words.count(word) > 1], [])
        self.assertGreater(len(words), 60)
        found = [problem for words, where in rows for problem in misnamed(words, where)]
        self.assertEqual(found, [], "\n" + "\n".join(found))


class Rules(unittest.TestCase):
    def test_notice_a_path_that_is_not_there(self):
        found = list(missing_paths("solve/a.cc", "int a;\n// see certify/no_such.h\n"))
        self.assertEqual(found, ["solve/a.cc:2: there is no certify/no_such.h"])
        self.assertEqual(len(list(missing_paths("doc/a.md", "see scripts/no_such.sh"))), 1)
        code = 'auto a = "certify/no_such.h";  // core/interval.h, core/*.h, app/NAME.cc'
        self.assertEqual(list(missing_paths("solve/a.cc", code)), [])

    def test_notice_a_link_that_leads_nowhere(self):
        self.assertEqual(len(list(broken_links("doc/a.md", "[a](no_such.md) [b](report.md#no-such-heading)"))), 2)
        links = "[a](report.md) [b](https://example.org/no) [c](../README.md#python)"
        self.assertEqual(list(broken_links("doc/a.md", links)), [])

    def test_notice_a_name_of_the_glossary_that_is_not_there(self):
        self.assertEqual(
            list(misnamed("panel", "`Panel`, certify/newton.h")), ["panel: there is no Panel in certify/newton.h"]
        )
        self.assertEqual(len(list(misnamed("x", "`Sheet::no_such`; `NoSuch`"))), 2)
        self.assertEqual(list(misnamed("x", "`Sheet::region`, `Cover::regions`")), [])


if __name__ == "__main__":
    unittest.main()
