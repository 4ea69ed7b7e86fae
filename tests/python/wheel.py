"""`pip wheel .` and what pip installs of it, with the build back-end that is there: no index is asked.

wheel.py SOURCE WORK SCOTOPIC; ends with 77 where pip or scikit-build-core is missing. Compiles the libraries once
more, into WORK/build, where a second run finds them.
"""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

SKIPPED = 77


def pip(*words):
    subprocess.run([sys.executable, "-m", "pip", "--disable-pip-version-check", *words], check=True)


def built(source, work):
    """The wheel's path."""
    wheels = work / "wheels"
    shutil.rmtree(wheels, ignore_errors=True)
    pip("wheel", "--no-index", "--no-deps", "--no-build-isolation", "--wheel-dir", str(wheels),
        f"--config-settings=build-dir={work / 'build'}", str(source))
    (wheel,) = wheels.iterdir()
    return wheel


def check_contents(wheel, source):
    version = re.search(r"project\(Scotopic VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text())[1]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    assert re.fullmatch(rf"scotopic-{re.escape(version)}-{python}-{python}-linux_\w+\.whl", wheel.name), wheel.name
    with zipfile.ZipFile(wheel) as archive:
        names = [name for name in archive.namelist() if ".dist-info/" not in name]
        metadata = archive.read(f"scotopic-{version}.dist-info/METADATA").decode()
    modules = [name for name in names if re.fullmatch(r"scotopic/_core\.\S+\.so", name)]
    rest = sorted(set(names) - set(modules))
    assert len(modules) == 1 and rest == [f"scotopic/{name}" for name in
                                          ("__init__.py", "__init__.pyi", "_photometry.py", "py.typed")], names
    for line in ("Name: scotopic", f"Version: {version}", "Requires-Dist: numpy>=1.19"):
        assert line in metadata.splitlines(), metadata
    print(f"{wheel.name}: {wheel.stat().st_size} bytes, {len(names)} files")


def check_installed(wheel, source, work, program):
    """The tests of arrays and words, with the module that pip has put elsewhere."""
    target = work / "installed"
    shutil.rmtree(target, ignore_errors=True)
    pip("install", "--no-index", "--no-deps", "--target", str(target), str(wheel))
    # Looks and views that ship are package scotopic's: here the sources', where the module looks for them.
    share = target / "share/scotopic"
    share.mkdir(parents=True)
    for folder in ("ocio_config", "luts"):
        (share / folder).symlink_to(source / folder)
    environment = dict(os.environ, PYTHONPATH=str(target), SCOTOPIC=program)
    where = subprocess.run([sys.executable, "-c", "import scotopic; print(scotopic.__file__)"], env=environment,
                           check=True, capture_output=True, text=True, cwd=work).stdout
    assert where.startswith(str(target)), where
    subprocess.run([sys.executable, "-B", "-m", "unittest", "test_arrays", "test_words"], env=environment,
                   check=True, cwd=source / "tests/python")


def main(source, work, program):
    for module, package in (("scikit_build_core", "python3-scikit-build-core (Debian 13)"), ("pip", "python3-pip")):
        if importlib.util.find_spec(module) is None:
            print(f"skipped: {sys.executable} has no {module}: {package}")
            return SKIPPED
    work.mkdir(parents=True, exist_ok=True)
    wheel = built(source, work)
    check_contents(wheel, source)
    check_installed(wheel, source, work, program)
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]))
