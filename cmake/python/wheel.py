"""What pip asks for a wheel (PEP 517): CMake builds and installs the module into a folder, and this
packs it, with the specifications that it reads. It needs nothing but CMake and Python.

STORMPROOF_JOBS is the number of parallel compilations; the build folder is build-python, as for
everybody else, so a second time takes seconds."""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build-python"


def _run(*words):
    subprocess.run([str(word) for word in words], cwd=ROOT, check=True, stdout=sys.stderr)


def _install(folder):
    """The package and its dist-info, as they are installed; the folder that holds both."""
    jobs = os.environ.get("STORMPROOF_JOBS") or str(os.cpu_count() or 1)
    _run("cmake", "--preset", "python", f"-DPython_EXECUTABLE={sys.executable}")
    _run("cmake", "--build", BUILD, "--target", "stormproof_python", "-j", jobs)
    _run("cmake", "--install", BUILD, "--component", "python", "--prefix", folder)
    (info,) = pathlib.Path(folder).rglob("stormproof-*.dist-info")
    specs = info.parent / "stormproof" / "specs"
    shutil.copytree(ROOT / "specs", specs, ignore=shutil.ignore_patterns("site", "ci"))
    return info


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _recorded(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as folder:
        info = _install(folder)
        (info / "WHEEL").write_text(
            "Wheel-Version: 1.0\nGenerator: stormproof\nRoot-Is-Purelib: false\n" f"Tag: {_tag()}\n",
            encoding="utf-8",
        )
        name = info.name.replace(".dist-info", f"-{_tag()}.whl")
        record = ""
        with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
            for path in sorted(info.parent.rglob("*")):
                if not path.is_file() or "__pycache__" in path.parts:
                    continue
                stored = path.relative_to(info.parent).as_posix()
                wheel.write(path, stored)
                record += _recorded(stored, path.read_bytes())
            wheel.writestr(f"{info.name}/RECORD", record + f"{info.name}/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("no source distribution; take a clone of the repository")
