"""Every block of the Python page runs."""

# SPDX-License-Identifier: MIT
import contextlib
import io
import os
import re
import shutil
import tempfile
import unittest

import isostep  # noqa: F401
import support

SOURCE = os.environ["ISOSTEP_SOURCE"]


class Page(unittest.TestCase):
    def test_every_block_of_the_page_runs(self):
        with open(os.path.join(SOURCE, "src/python/README.md"), encoding="utf-8") as file:
            blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.S | re.M)
        self.assertGreaterEqual(len(blocks), 5)
        before, names = os.getcwd(), {"__name__": "page"}
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
            for name, scalar in (("float.replay", "float"), ("fixed.replay", "q32.32")):
                shutil.copy(support.recorded("S1x5", scalar, 90)[0], os.path.join(folder, name))
            os.chdir(folder)
            try:
                for block in blocks:
                    exec(compile(block, "src/python/README.md", "exec"), names)
            finally:
                os.chdir(before)
        self.assertGreater(len(said.getvalue().splitlines()), 5)


if __name__ == "__main__":
    unittest.main()
