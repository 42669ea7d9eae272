# SPDX-License-Identifier: Apache-2.0
"""Generates the messages from protocol/raybundle.proto before the package is built; all else is in pyproject.toml."""
import os
import shutil
import subprocess
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent


def proto_file() -> Path:
    """The one declaration: beside this folder in the repository, in it in a source package."""
    for folder in (HERE, HERE.parent, *map(Path, filter(None, [os.environ.get("RAYBUNDLE_PROTO_DIR")]))):
        if (folder / "raybundle.proto").is_file():
            return folder / "raybundle.proto"
    raise SystemExit(f"{HERE}: no raybundle.proto here nor in the folder above; name its folder in RAYBUNDLE_PROTO_DIR")


def generate(folder: Path) -> None:
    """Writes raybundle_pb2.py and its types into a folder."""
    compiler = shutil.which("protoc")
    if compiler is None:
        raise SystemExit("protoc is missing; Debian's package is protobuf-compiler")
    proto = proto_file()
    subprocess.run([compiler, f"-I{proto.parent}", f"--python_out={folder}", f"--pyi_out={folder}", str(proto)],
                   check=True)


class BuildWithMessages(build_py):
    def run(self) -> None:
        super().run()
        target = Path(self.build_lib) / "raybundle"
        if self.editable_mode:
            target = HERE / "raybundle"
        target.mkdir(parents=True, exist_ok=True)
        generate(target)


class SourceWithDeclaration(sdist):
    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        super().make_release_tree(base_dir, files)
        shutil.copy(proto_file(), Path(base_dir) / "raybundle.proto")


setup(cmdclass={"build_py": BuildWithMessages, "sdist": SourceWithDeclaration})
