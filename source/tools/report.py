# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes report.html of a run: one page that needs no other file."""

import base64
import html
import json

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 0.5em 0; } td, th { padding: 0.15em 0.8em; text-align: left; border-bottom: 1px solid #e4e4e4; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
figure { margin: 1em 0; } figure img { max-width: 100%; border: 1px solid #ddd; } figcaption { color: #555; }
.failed { color: #a00; } code { background: #f3f3f3; padding: 0 0.2em; } .warning { background: #fff6dd; padding: 0.3em 0.8em; margin: 0.3em 0; }
"""


def text(value):
    return html.escape(str(value))


def number(value):
    """A figure with four digits, a count with all of them."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list):
        return ", ".join(number(entry) for entry in value)
    return text(value)


def table(header, rows):
    """Columns after the first hold numbers, flush right."""
    if not rows:
        return ""
    kind = lambda column: ' class="number"' if column > 0 else ""
    head = "".join(f"<th{kind(k)}>{text(word)}</th>" for k, word in enumerate(header))
    body = "".join("<tr>" + "".join(f"<td{kind(k)}>{cell}</td>" for k, cell in enumerate(row)) + "</tr>\n" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table>\n"


def leaves(tree, path=()):
    """(path, value) of all values of a tree of objects."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from leaves(value, path + (key,))
        else:
            yield path + (key,), value


def figure(directory, name, title):
    kind = {"png": "image/png", "svg": "image/svg+xml"}[name.rsplit(".", 1)[1]]
    data = base64.b64encode((directory / name).read_bytes()).decode()
    return f'<figure><img alt="{text(title)}" src="data:{kind};base64,{data}"><figcaption>{text(title)}</figcaption></figure>\n'


def facts(summary):
    """What was computed."""
    mesh, neighbours = summary.get("mesh", {}), summary.get("neighbours", {})
    parameters = summary.get("parameters", {})
    solver = summary.get("solver", {})
    rows = [("scene", f"<code>{text(summary.get('command', ''))}</code>"),
            ("status", text(summary.get("status", "unknown"))),
            ("body", f"{mesh.get('dim', '?')}-D, {number(mesh.get('cells'))} cells of {number(mesh.get('min_size'))} to "
                     f"{number(mesh.get('max_size'))} m, volume {number(mesh.get('volume'))} m³"),
            ("nodes", number(summary.get("nodes"))),
            ("bonds", f"{number(summary.get('bonds'))}; a node has {number(neighbours.get('min'))} to {number(neighbours.get('max'))} "
                      f"neighbours, {number(neighbours.get('mean'))} on average"),
            ("model", f"{text(summary.get('model', ''))}, {text(summary.get('variant', ''))}"),
            ("solver", text(parameters.get("Solver", {}).get("Name", solver.get("name", "")))
             + (f", {number(solver['steps'])} step{'s' * (solver['steps'] != 1)}" if "steps" in solver else "")
             + (", converged" if solver.get("converged") is True else ", not converged" if solver.get("converged") is False else "")),
            ("ranks", number(summary.get("ranks"))),
            ("memory", f"{summary['memory_bytes'] / 1e6:,.0f} MB" if "memory_bytes" in summary else "-")]
    return table(["", ""], rows).replace("<td class=\"number\">", "<td>")


def error_rows(errors, title=""):
    """Rows of relative errors: against what, l2, largest; profiles below."""
    for name, entry in errors.items():
        if not isinstance(entry, dict):
            continue
        label = f"{title}, {name}" if title else f"against {name}"
        if "l2" in entry:
            yield text(label), number(entry["l2"]), number(entry.get("max"))
        for profile, components in entry.get("profiles", {}).items():
            for component, value in components.items():
                yield text(f"{label}: {component} along {profile}"), "", number(value)
        yield from error_rows({k: v for k, v in entry.items() if k != "profiles"}, label)


def vector_table(vectors, unit):
    axes = "xyz"[: max((len(v) for v in vectors.values() if isinstance(v, list)), default=0)]
    return table(["boundary"] + [f"along {axis} [{unit}]" for axis in axes],
                 [(text(name), *(number(value) for value in values)) for name, values in vectors.items() if isinstance(values, list)])


def parameter_rows(summary):
    """Parameters that have another value than their default."""
    given = {"/".join(path): value for path, value in leaves(summary.get("parameters", {}))}
    defaults = summary.get("changed_from", {})
    return [(f"<code>{text(path)}</code>", text(given.get(path, "")), text(default) or "none") for path, default in defaults.items()]


def sections(summary, directory, pictures, curves):
    """(title, HTML) of the parts of the page; parts without contents are left out."""
    yield "What was computed", facts(summary)
    yield "Warnings", "".join(f'<p class="warning">{text(line)}</p>\n' for line in summary.get("warnings", []))
    yield "Pictures", "".join(figure(directory, *entry) for entry in pictures)
    yield "Curves", "".join(figure(directory, *entry) for entry in curves)
    yield "Errors", table(["relative error", "l2", "largest"], list(error_rows(summary.get("errors", {}))))
    yield "Energies", table(["energy", "value [J]"], [(text(name), number(value)) for name, value in summary.get("energy", {}).items()
                                                     if name != "drift"])
    yield "Reactions", vector_table(summary.get("reactions", {}), "N")
    yield "Displacements of boundaries", vector_table(summary.get("displacements", {}), "m")
    yield "Damage", table(["", ""], [(text(" ".join(path).replace("_", " ")), number(value))
                                     for path, value in leaves(summary.get("damage", {})) if not isinstance(value, list)])
    seconds = dict(summary.get("seconds", {}))
    total = seconds.pop("total", None)
    rows = [(text(name), number(float(value)), f"{100 * value / total:.0f} %") for name, value in seconds.items()] if total else []
    yield "Time", table(["phase", "seconds", "share"], rows + ([("total", number(float(total)), "100 %")] if total else []))
    rows = parameter_rows(summary)
    yield "Parameters that differ from their defaults", \
        table(["parameter", "value", "default"], rows).replace('class="number"', "") if rows else ""
    yield "All parameters", "<details><summary>as used</summary><pre>" + text(json.dumps(summary.get("parameters", {}), indent=1)) + "</pre></details>"
    yield "Versions", table(["part", "version"], [(text(k), text(v)) for k, v in summary.get("versions", {}).items()])


def write_report(directory, summary, pictures, curves):
    """Writes report.html; pictures and curves are (file name, title) of files in the directory."""
    name = directory.resolve().name
    failed = "" if summary.get("status") == "done" else ' class="failed"'
    parts = "".join(f"<h2>{title}</h2>\n{content}" for title, content in sections(summary, directory, pictures, curves) if content)
    page = (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{text(name)}</title>\n<style>{STYLE}</style></head><body>\n'
            f"<h1{failed}>{text(name)}: {text(summary.get('status', 'unknown'))}</h1>\n{parts}</body></html>\n")
    path = directory / "report.html"
    part = path.with_suffix(".part")
    part.write_text(page, encoding="utf-8")
    part.replace(path)
    return path.name
