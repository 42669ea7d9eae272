#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The dashboard and the alert rules name figures that the server has: check_monitoring.py ROOT"""
import json
import re
import sys
from pathlib import Path


def figures_of_the_server(root):
    """As deploy/README.md lists them; the metrics' own test holds that list to the server."""
    names = set()
    for line in (root / "deploy/README.md").read_text().splitlines():
        if line.startswith("| `raybundle_"):
            first = ""
            for name in re.findall(r"`([a-z_]+)(?:\{[^}]*\})?`", line.split("|")[1]):
                first = first or name
                names.add(name if name.startswith("raybundle_") else "raybundle" + name)
                names.add(first + name)
    return names


def main():
    root = Path(sys.argv[1])
    known, failures = figures_of_the_server(root), 0
    dashboard = json.loads((root / "deploy/monitoring/grafana.json").read_text())
    expressions = [target["expr"] for panel in dashboard["panels"] for target in panel["targets"]]
    alerts = (root / "deploy/monitoring/alerts.yaml").read_text()
    expressions += re.findall(r"expr: (.*)", alerts)
    for expression in expressions:
        for name in re.findall(r"raybundle_[a-z_]+", expression):
            if name not in known:
                print(f"no figure {name}: {expression}", file=sys.stderr)
                failures += 1
    ids = [panel["id"] for panel in dashboard["panels"]]
    failures += len(ids) != len(set(ids))
    print(f"{len(expressions)} expressions, {failures} failures")
    return 1 if failures or len(expressions) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
