"""Checks that everything that documents and comments name exists: files, functions (`path:function`), relative links and
their headings, and decisions."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
top = "reyes|raytrace|gi|shaders|displays|scenes|tests|docs"
named = re.compile(rf"(?<![\w./-])((?:{top})/[\w./-]*\w)(?::([A-Za-z_][\w:~]*))?")
linked = re.compile(r"\]\((?!https?:|mailto:)([^)#\s]*)(?:#([^)\s]*))?\)")
bad = []


def exists(path):
    """Returns whether a path of the tree exists. docs/decisions/0040 stands for the page of that number."""
    number = re.fullmatch(r"docs/decisions/(\d{4})", path)
    return len(list(root.glob(f"{path}-*.md"))) == 1 if number else (root / path).exists()


def anchors(page):
    """Returns the names that a page's headings have in links, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.*?) *$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def check_paths(file, text):
    for path, function in named.findall(text):
        if not exists(path):
            bad.append(f"{file.relative_to(root)} names {path}, which does not exist")
        elif function and (root / path).is_file() and function.split("::")[-1] not in (root / path).read_text():
            bad.append(f"{file.relative_to(root)} names {function} in {path}, which does not mention it")


def check_links(page, text):
    for path, anchor in linked.findall(text):
        target = page.parent / path if path else page
        if not target.exists():
            bad.append(f"{page.relative_to(root)} links to {path}, which does not exist")
        elif anchor and anchor not in anchors(target):
            bad.append(f"{page.relative_to(root)} links to {path}#{anchor}, and there is no such heading")


pages = [*root.glob("*.md"), *(page for folder in top.split("|") for page in (root / folder).rglob("*.md"))]
for page in pages:
    text = page.read_text()
    for quoted in re.findall(r"`+([^`]+)`+", text):
        check_paths(page, quoted)
    check_links(page, text)

index = (root / "docs/README.md").read_text()
for page in sorted((root / "docs").glob("*.md")):
    if page.name != "README.md" and f"]({page.name})" not in index:
        bad.append(f"docs/README.md does not list {page.name}")

# Nobody can read a guide that is too long. Measurements and reasons have folders of their own.
most_words = 30000
guide = [root / "README.md", *(root / "docs").glob("*.md")]
words = sum(bool(re.search(r"\w", word)) for page in guide for word in page.read_text().split())
if words > most_words:
    bad.append(f"README.md and docs/*.md have {words} words; {most_words} are the limit")

texts = {".h", ".cpp", ".py", ".txt", ".rib", ".c", ".md"}
files = [*root.glob("*.*"), *(file for folder in top.split("|") for file in (root / folder).rglob("*.*"))]
for file in files:
    if file.suffix in texts:
        for path in re.findall(r"(?<![\w./-])docs/[\w./-]*\w", file.read_text(errors="replace")):
            if not exists(path):
                bad.append(f"{file.relative_to(root)} names {path}, which does not exist")

print("\n".join(sorted(set(bad))))
sys.exit(bool(bad))
