"""Do the links of these Markdown files lead somewhere? Only within the project: files, and headings as GitHub names them."""

import re
import sys
from pathlib import Path

FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)


def text_of(file):
    return FENCED.sub(lambda code: "\n" * code.group().count("\n"), file.read_text(encoding="utf-8"))


def anchors(file):
    names = []
    for heading in HEADING.findall(text_of(file)):
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        names.append(f"{name}-{names.count(name)}" if name in names else name)
    return names


def fault(file, target):
    path, _, anchor = target.partition("#")
    other = file.parent / path if path else file
    if not other.exists():
        return f"there is no {other}"
    if anchor and anchor not in anchors(other):
        return f"{other} has no heading #{anchor}"
    return None


def faults(file):
    text = text_of(file)
    for link in LINK.finditer(text):
        target = link.group(1)
        if re.match(r"[a-z]+:", target):
            continue
        why = fault(file, target)
        if why:
            line = text.count("\n", 0, link.start()) + 1
            yield f"{file}:{line}: {why}"


found = [line for file in sys.argv[1:] for line in faults(Path(file))]
for line in found:
    print(line)
sys.exit(bool(found))
