#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds the sizes of files and classes, and what chooses behaviour, against fixed limits.

- A file of include/perideal or source has at most 350 lines.
- A class or struct declared in include/perideal has at most 25 methods (constructors, operators and overloads
  count; what is inherited and what nested classes declare does not) and at most 12 data members (static ones
  count, constexpr ones do not). A plain record that a scene's section fills (a struct with declare()) is a table of
  parameters: its members are that section's parameters and may be more.
- Text chooses behaviour only where it is read: no comparison with a string literal outside TEXT_IS_READ_IN.

    check_structure.py [ROOT]       checks ROOT/include/perideal and ROOT/source
    check_structure.py --self-test  shows that each kind of violation is found
"""

import re
import sys
import tempfile
from pathlib import Path

LARGEST_FILE = 350
LARGEST_NUMBER_OF_METHODS = 25
LARGEST_NUMBER_OF_MEMBERS = 12

# Files that read text: meshes, parameters, the command line, checkpoints.
TEXT_IS_READ_IN = {
    "source/application/command_line.cc",
    "source/application/main.cc",
    "source/application/print_parameters.cc",
    "source/base/registry.cc",
    "source/mesh/abaqus_deck.cc",
    "source/mesh/gmsh_inner_faces.cc",
    "source/mesh/gmsh_lines.cc",
    "source/mesh/gmsh_scan.cc",
    "source/mesh/mesh_file.cc",
    "source/mesh/read_gmsh.cc",
    "source/output/checkpoint.cc",
    "source/output/checkpoint_file.cc",
    "source/parameters/elastic_symmetry.cc",
    "source/parameters/parameter_file.cc",
    "source/parameters/point_text.cc",
}

STRING = r'"(?:[^"\\\n]|\\.)+"'
COMPARISON = re.compile(rf"[=!]=\s*{STRING}|{STRING}\s*[=!]=|\bcompare\s*\([^;]*?{STRING}|\bstarts_with\s*\(\s*{STRING}")
CLASS = re.compile(r"\b(class|struct|union)\s+(?:alignas\s*\([^)]*\)\s*)?([A-Za-z_][\w:]*)([^;{}()=]*)\{")


def without_comments(text, keep_strings):
    """The text with comments, and literals where asked, as blanks; line numbers stay."""

    def blank(match):
        found = match.group(0)
        if found[0] in "\"'":
            return found if keep_strings else found[0] + found[0]
        return "\n" * found.count("\n") + " "

    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"|(?<![0-9a-fA-F])\'(?:[^\'\\\n]|\\.)+\'', blank, text, flags=re.S)


def end_of(text, start, opening, closing):
    """Position behind the bracket that closes the one at start."""
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] == opening) - (text[at] == closing)
        if depth == 0:
            return at + 1
    return len(text)


def statements(body):
    """The declarations in the body of a class; each block { } of a function or class stands as {}."""
    result, current, at = [], "", 0
    while at < len(body):
        character = body[at]
        if character in "([":
            end = end_of(body, at, character, ")]"["([".index(character)])
            current += body[at:end]
            at = end
        elif character == "{":
            end = end_of(body, at, "{", "}")
            current += "{}"
            rest = body[end:].lstrip()
            at = end
            # A function ends with its body; an initialiser and a nested class go on to the semicolon.
            if shape_of(current) == "method" and not rest.startswith((",", "{")):
                if rest.startswith(";"):
                    at = body.index(";", end) + 1
                result.append(current)
                current = ""
        elif character == ";":
            result.append(current)
            current, at = "", at + 1
        else:
            current += character
            at += 1
    return [" ".join(s.split()) for s in result if s.strip()]


def without_templates(declaration):
    """The declaration without its < > that hold arguments of templates."""
    result, depth = "", 0
    for at, character in enumerate(declaration):
        if character == "<" and not result.rstrip().endswith(("operator", "operator<")):
            depth += 1
        elif character == ">" and depth > 0 and declaration[at - 1] != "-":
            depth -= 1
        elif depth == 0:
            result += character
    return result


def shape_of(statement):
    """method | members | neither"""
    statement = re.sub(r"\b(public|protected|private)\s*:(?!:)", " ", statement)
    statement = re.sub(r"\[\[.*?\]\]|\balignas\s*\([^)]*\)|__attribute__\s*\(\(.*?\)\)", " ", statement)
    plain = " ".join(without_templates(statement).split())
    plain = re.sub(r"^(template )+", "", plain)
    if re.match(r"(using|typedef|friend|static_assert|enum|class|struct|union)\b", plain) or not plain:
        return "neither"
    if "operator" in plain.split("(")[0]:
        return "method"
    head = re.split(r"=|\{", plain)[0]
    if "(" in head and not re.search(r"\(\s*\*", head):
        return "method"
    return "neither" if re.search(r"\bconstexpr\b", head) else "members"


def number_of_members(statement):
    """How many names a declaration such as `double a = 0, b[2], c;` declares."""
    plain = without_templates(statement)
    plain = re.sub(r"\([^()]*\)|\[[^\]]*\]|\{\}", "", plain)
    return plain.count(",") + 1


def classes(text):
    """(line, name, methods, members, is a section of parameters) of each class that a header defines."""
    text = without_comments(text, keep_strings=False)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)
    for match in CLASS.finditer(text):
        if re.search(r"\benum\s*$", text[: match.start()]):
            continue
        opening = match.end() - 1
        body = text[opening + 1 : end_of(text, opening, "{", "}") - 1]
        found = statements(body)
        methods = sum(shape_of(s) == "method" for s in found)
        members = sum(number_of_members(s) for s in found if shape_of(s) == "members")
        is_section = any(re.match(r"(public: )?void declare\(", s) for s in found) and match.group(1) == "struct"
        yield text.count("\n", 0, match.start()) + 1, match.group(2), methods, members, is_section


def check_file(path, root):
    """Violations of one file."""
    name, text = path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")
    violations = []
    n_lines = len(text.splitlines())
    if n_lines > LARGEST_FILE:
        violations.append(f"{name}: {n_lines} lines, more than {LARGEST_FILE}")
    if path.suffix == ".h":
        for line, label, methods, members, is_section in classes(text):
            if methods > LARGEST_NUMBER_OF_METHODS:
                violations.append(f"{name}:{line}: {label} has {methods} methods, more than {LARGEST_NUMBER_OF_METHODS}")
            if members > LARGEST_NUMBER_OF_MEMBERS and not is_section:
                violations.append(f"{name}:{line}: {label} has {members} members, more than {LARGEST_NUMBER_OF_MEMBERS}")
    if name not in TEXT_IS_READ_IN:
        plain = without_comments(text, keep_strings=True)
        for match in COMPARISON.finditer(plain):
            line = plain.count("\n", 0, match.start()) + 1
            violations.append(f"{name}:{line}: chooses by text: {' '.join(match.group(0).split())}")
    return violations


def check_tree(root):
    """(number of files, violations) of a source tree."""
    files, violations = 0, []
    for folder in (root / "include" / "perideal", root / "source"):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".h", ".cc"):
                files += 1
                violations += check_file(path, root)
    return files, violations


def self_test():
    """Every good file passes and every bad one is found."""
    header, source = "include/perideal/nodes/example.h", "source/nodes/example.cc"
    many = "".join(f"  void method_{k}() const {{ if (a) {{ b(); }} }}\n" for k in range(25))
    twelve = "".join(f"  std::map<int, std::function<double(int)>> a_{k};\n" for k in range(12))
    cases = [
        (source, "\n" * 350, 0),
        (source, "\n" * 351, 1),
        (header, f"template <int dim> class A : public B<dim>\n{{\npublic:\n{many}{twelve}}};", 0),
        (header, f"class A\n{{\npublic:\n{many}  A() = default;\n}};", 1),
        (header, f"class A\n{{\n{many}  explicit A(const int b) : b(b), c{{b}} {{ }}\n}};", 1),
        (header, f"class A\n{{\n{many}  bool operator<(const A &) const;\n}};", 1),
        (header, f"class A\n{{\n{many}  template <typename T> const std::vector<T> &value() const;\n}};", 1),
        (header, f"class A\n{{\n{many}  static constexpr int n = f(3);\n  enum class E {{ a, b }};\n  using C = D;\n}};", 0),
        (header, f"class A\n{{\n{many}  friend void f(A &);\n  // void not_there();\n}};", 0),
        (header, f"struct A\n{{\n{twelve}}};", 0),
        (header, f"struct A\n{{\n{twelve}  double b;\n}};", 1),
        (header, f"struct A\n{{\n{twelve}  static unsigned int count;\n}};", 1),
        (header, "struct A\n{\n  double a = 0, b[2] = {1, 2}, c, d, e, f, g;\n  int h, i, j, k, l, m;\n};", 1),
        (header, "struct A\n{\n  double a = 0, b[2] = {1, 2}, c, d, e, f, g;\n  int h, i, j, k, l;\n};", 0),
        (header, f"struct A\n{{\n  struct B\n  {{\n{twelve}  }};\n{twelve}  void f();\n}};", 0),
        (header, f"struct A\n{{\n  struct B\n  {{\n{twelve}    int b;\n  }};\n}};", 1),
        (header, f"struct A\n{{\n  struct {{\n    int x; }} b;\n{twelve}  std::array<int, 2> c{{}};\n}};", 1),
        (header, f"struct A\n{{\n{twelve}  double b;\n  void declare(dealii::ParameterHandler &prm);\n}};", 0),
        (source, 'if (name == "static") a();', 1),
        (source, 'if ("static" != name) a();', 1),
        (source, 'if (name.compare(0, 8, "trilinos") == 0) a();', 1),
        (source, '// if (name == "static")\nif (name == "" || a == b) print("a == b");', 0),
        ("source/mesh/gmsh_scan.cc", 'if (line == "$Nodes") a();', 0),
    ]
    failures = 0
    for path, text, expected in cases:
        with tempfile.TemporaryDirectory() as root:
            file = Path(root) / path
            file.parent.mkdir(parents=True)
            file.write_text(text, encoding="utf-8")
            files, violations = check_tree(Path(root))
        if files != 1 or len(violations) != expected:
            failures += 1
            print(f"{text}: {violations} instead of {expected} violations")
    print(f"self-test: {len(cases) - failures} of {len(cases)} cases as expected")
    return 1 if failures else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    files, violations = check_tree(root)
    for violation in violations:
        print(violation)
    print(f"{files} files, {len(violations)} violations")
    return 1 if violations or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
