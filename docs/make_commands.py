"""Write the reference of the commands, docs/commands.md; with --man, manual pages.

Usage: python docs/make_commands.py [--man FOLDER]

Both are made from the commands themselves. A manual page is read with
``man FOLDER/alphamesh-mesh.1``; in a folder ``share/man/man1``, with ``man alphamesh-mesh``.
"""

import re
import sys
from pathlib import Path

import click

from alphamesh.cli.app import COMMANDS, EXAMPLES, EXIT_CODES, app, version_text

PAGE = Path(__file__).parent / "commands.md"

INTRODUCTION = """Made from the commands themselves by `python docs/make_commands.py`; with
`--man FOLDER` it writes manual pages. Every command tells the same with `--help`."""

# Sections of options that many commands share: told once, at the end of the page.
COMMON = ("Many files", "Points from images", "Files of points", "General")


def commands(group=app, parent=None, before=""):
    """Yield name, command and a context of each, those of groups such as tiles one by one."""
    settings = {} if parent else app.context_settings
    context = click.Context(group, parent=parent, info_name=before or "alphamesh", **settings)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        whole = f"{before} {name}".strip()
        if isinstance(command, click.Group):
            yield from commands(command, context, whole)
        else:
            yield whole, command, click.Context(command, parent=context, info_name=name)


def brief(name, command):
    """Return what a command does in a few words."""
    return COMMANDS.get(name) or paragraphs(command.help)[0].rstrip(".")


def paragraphs(text):
    """Return the paragraphs of a docstring, each on one line."""
    parts = re.split(r"\n\s*\n", (text or "").strip())
    return [" ".join(part.split()) for part in parts]


def usage(name, command, context):
    return " ".join(["alphamesh", name, *command.collect_usage_pieces(context)])


# ---------------------------------------------------------------------- the page


def marked(text):
    """Return plain text as Markdown."""
    return re.sub(r"([*_<>|])", r"\\\1", text)


def options_table(records):
    rows = (
        f"| `{names.replace('|', '/')}` | {marked(' '.join(told.split()))} |"
        for names, told in records
    )
    return "\n".join(["| option | what it does |", "|---|---|", *rows])


def page():
    """Return the reference as Markdown."""
    common = {title: {} for title in COMMON}
    entries, links = [], []
    for name, command, context in commands():
        short, *rest = paragraphs(command.help)
        anchor = f"alphamesh-{name.replace(' ', '-')}"
        links.append(f"| [`{name}`](#{anchor}) | {marked(brief(name, command))} |")
        sections = command.sections(context)
        for title in COMMON:
            for names, told in sections.get(title, ()):
                common[title].setdefault(names, told)
        parts = [
            f"## alphamesh {name}",
            marked(short),
            *map(marked, rest),
            f"```text\n{usage(name, command, context)}\n```",
        ]
        if "Options" in sections:
            parts.append(options_table(sections["Options"]))
        also = [title for title in COMMON if title in sections]
        shared = ", ".join(f"[{title}](#{title.lower().replace(' ', '-')})" for title in also)
        parts.append(f"Also: {shared}.")
        if command.examples:
            parts.append("```text\n" + "\n".join(command.examples) + "\n```")
        entries.append("\n\n".join(parts))
    shared = [
        f"### {title}\n\n{options_table(records.items())}" for title, records in common.items()
    ]
    codes = "\n".join(
        f"| {code.split()[0]} | {marked(' '.join(code.split()[1:]))} |" for code in EXIT_CODES
    )
    return (
        "\n\n".join(
            [
                "# Commands",
                INTRODUCTION,
                "| command | what it does |\n|---|---|\n" + "\n".join(links),
                *entries,
                "## Common options",
                *shared,
                "## Exit codes",
                "| code | meaning |\n|---|---|\n" + codes,
            ]
        )
        + "\n"
    )


# ---------------------------------------------------------------------- manual pages


def troff(text):
    """Return plain text so that troff prints it as it is."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", escaped, flags=re.MULTILINE)


def head(name, short):
    title = name.upper()
    version = version_text().strip("()")
    return [
        f'.TH "{troff(title)}" "1" "" "alphamesh {troff(version)}" "alphamesh"',
        ".SH NAME",
        f"{troff(name)} \\- {troff(short)}",
    ]


def listing(lines):
    return [".PP", ".nf", *(troff(f"    {line}") for line in lines), ".fi"]


def defined(term, told):
    return [".TP", f"\\fB{troff(term)}\\fR", troff(" ".join(told.split()))]


def page_name(name):
    return f"alphamesh-{name.replace(' ', '-')}"


def manual(name, command, context):
    """Return the manual page of a command."""
    lines = head(page_name(name), brief(name, command))
    lines += [".SH SYNOPSIS", troff(usage(name, command, context)), ".SH DESCRIPTION"]
    for text in paragraphs(command.help):
        lines += [".PP", troff(text)]
    for title, records in command.sections(context).items():
        lines.append(f".SH {troff(title.upper())}")
        for names, told in records:
            lines += defined(names, told)
    if command.examples:
        lines += [".SH EXAMPLES", *listing(command.examples)]
    lines += [".SH SEE ALSO", "\\fBalphamesh\\fR(1)"]
    return "\n".join(lines) + "\n"


def manual_of_all():
    """Return the manual page of the program."""
    lines = head("alphamesh", "point clouds into meshes by their alpha complexes")
    lines += [".SH SYNOPSIS", troff("alphamesh COMMAND [OPTIONS] ..."), ".SH DESCRIPTION"]
    lines += [troff(text) for text in paragraphs(app.help)]
    lines.append(".SH COMMANDS")
    for name, command, _ in commands():
        lines += defined(f"{page_name(name)}(1)", brief(name, command))
    lines.append(".SH EXIT STATUS")
    for code in EXIT_CODES:
        number, told = code.split(maxsplit=1)
        lines += defined(number, told)
    lines += [".SH EXAMPLES", *listing(EXAMPLES)]
    return "\n".join(lines) + "\n"


def write_manuals(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "alphamesh.1").write_text(manual_of_all(), encoding="utf-8")
    for name, command, context in commands():
        path = folder / f"{page_name(name)}.1"
        path.write_text(manual(name, command, context), encoding="utf-8")


def main(arguments):
    if arguments[:1] == ["--man"] and len(arguments) == 2:
        write_manuals(Path(arguments[1]))
    elif not arguments:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
