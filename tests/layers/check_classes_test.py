#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests tools/check_classes.py on small classes, then counts the server's own."""
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tools"))
import check_classes  # noqa: E402


class Classes(unittest.TestCase):
    def count(self, body):
        """Data members of `class A { body };`."""
        return check_classes.count_members("class A : public B<C> {\n" + body + "\n};\n")["A"]

    def test_names_are_counted(self):
        self.assertEqual(self.count("int a_ = 0, b_{1}; // c_, d_;\nstd::map<int, float> e_; const F& f_;"), 4)

    def test_functions_are_not(self):
        self.assertEqual(self.count("A(int a, int b); int f(int a = 1) const { int b = 2; return b; }"), 0)
        self.assertEqual(self.count("static constexpr int most = 3; using X = int; friend class Y;"), 0)
        self.assertEqual(self.count("bool operator==(const A& other) const = default;"), 0)

    def test_a_member_that_is_a_function_object_is_one(self):
        self.assertEqual(self.count("std::function<void(int, float)> done_;"), 1)

    def test_nested_classes_count_apart(self):
        counts = check_classes.count_members("struct A { struct B { int x, y; } b_; enum class C { d, e }; int c; };")
        self.assertEqual(counts, {"A": 2, "A::B": 2})

    def test_a_class_with_too_many_is_found(self):
        found = check_classes.find_violations([(16, "a.h: A"), (15, "b.h: B"), (17, "c.h: C")], {"C", "B"})
        self.assertEqual(len(found), 2)
        self.assertIn("a.h: A: 16", found[0])
        self.assertIn("B: is small enough", found[1])

    def test_no_other_class_of_the_server_has_too_many(self):
        counts = check_classes.count_all(root / "server")
        self.assertGreater(len(counts), 300)
        self.assertEqual(check_classes.find_violations(counts, check_classes.larger), [])


if __name__ == "__main__":
    unittest.main()
