#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests tools/check_layers.py on small projects, then the server's own layers."""
import sys
import tempfile
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tools"))
import check_layers  # noqa: E402


class Layers(unittest.TestCase):
    def project(self, extra):
        """Two layers, `high` above `low`, and `extra`: text by file."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        files = {
            "low/CMakeLists.txt": "add_library(raybundle_low STATIC\n    low.cpp\n)\n",
            "high/CMakeLists.txt": "add_library(raybundle_high STATIC high.cpp)\n"
            "target_link_libraries(raybundle_high PUBLIC raybundle_low)\n",
            "low/low.h": "",
            "low/low.cpp": '#include "low/low.h"\n',
            "low/only_header.h": "",
            "high/high.h": '#include "low/low.h"\n',
            "high/high.cpp": '#include "high/high.h"\n#include "low/only_header.h"\n#include <vector>\n',
            **extra,
        }
        for name, text in files.items():
            path = Path(folder.name) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return check_layers.find_violations(Path(folder.name))

    def test_what_is_linked_may_be_included(self):
        self.assertEqual(self.project({}), [])

    def test_a_higher_layer_may_not(self):
        found = self.project({"low/low.cpp": '#include "high/high.h"\n'})
        self.assertEqual(len(found), 1)
        self.assertIn("low/low.cpp: includes high/high.h", found[0])

    def test_a_header_alone_has_the_layer_of_its_folder(self):
        self.assertEqual(len(self.project({"low/only_header.h": '#include "high/high.h"\n'})), 1)

    def test_folders_below_a_library_are_its_own(self):
        self.assertEqual(self.project({"low/deep/part.h": '#include "low/low.h"\n'}), [])
        self.assertEqual(len(self.project({"low/deep/part.h": '#include "high/high.h"\n'})), 1)

    def test_headers_listed_apart_are_a_layer_of_their_own(self):
        listed = {
            "high/CMakeLists.txt": "add_library(raybundle_high STATIC high.cpp)\n"
            "target_link_libraries(raybundle_high PUBLIC raybundle_low)\n"
            "add_library(raybundle_names INTERFACE names.h)\n",
            "high/names.h": "",
            "low/CMakeLists.txt": "add_library(raybundle_low STATIC low.cpp)\n"
            "target_link_libraries(raybundle_low PUBLIC raybundle_names)\n",
        }
        self.assertEqual(self.project({**listed, "low/low.cpp": '#include "high/names.h"\n'}), [])
        self.assertEqual(len(self.project({**listed, "low/low.cpp": '#include "high/high.h"\n'})), 1)

    def test_the_server_has_no_include_that_goes_the_wrong_way(self):
        self.assertEqual(check_layers.find_violations(root / "server"), [])

    def test_no_folder_of_sources_has_more_than_it_has_room_for(self):
        # Folders still to be divided, with what they have now; no other may pass `room`.
        room = 30
        crowded = {}
        for folder in sorted(path for path in (root / "server").rglob("*") if path.is_dir()):
            count = sum(1 for file in folder.iterdir() if file.suffix in (".h", ".cpp", ".comp", ".glsl", ".vert", ".frag"))
            name = folder.relative_to(root / "server").as_posix()
            self.assertLessEqual(count, crowded.get(name, room), name)


if __name__ == "__main__":
    unittest.main()
