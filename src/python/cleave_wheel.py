"""Packs the module, and the program if it is built, as a wheel for pip (PEP 517 and 660; named in pyproject.toml).

The version is that of cleave/__init__.py. Other metadata is that of pyproject.toml, which pip reads; the wheel repeats it.
"""

import base64
import hashlib
import os
import re
import sysconfig
import zipfile

_HERE = os.path.dirname(os.path.abspath(__file__))
_PROGRAM = os.path.join(_HERE, "..", "..", "build", "cleave")
_LICENCE = os.path.join(_HERE, "..", "..", "LICENSE")


def _read(*names):
    with open(os.path.join(_HERE, *names), encoding="utf-8") as file:
        return file.read()


def _metadata(version):
    """Returns the text of METADATA, from pyproject.toml."""
    project = _read("pyproject.toml")

    def text(key):
        return re.search(r'^%s = "(.*)"$' % key, project, re.M).group(1)

    lines = ["Metadata-Version: 2.1", "Name: cleave", "Version: " + version, "Summary: " + text("description"),
             "License: BSD-3-Clause", "Requires-Python: " + text("requires-python")]
    listed = re.search(r"^dependencies = \[(.*)\]$", project, re.M).group(1)
    lines += ["Requires-Dist: " + name for name in re.findall(r'"(.*?)"', listed)]
    for extra, names in re.findall(r"^(\w+) = \[(.*)\]$", project.partition("[project.optional-dependencies]")[2], re.M):
        lines += ["Provides-Extra: " + extra]
        lines += ['Requires-Dist: %s; extra == "%s"' % (name, extra) for name in re.findall(r'"(.*?)"', names)]
    return "\n".join(lines) + "\n"


def _write(folder, files, platform):
    """Writes a wheel. files: contents as bytes, or the path of an executable, by name in the wheel. Returns the wheel's name."""
    version = re.search(r'^__version__ = "(.*)"$', _read("cleave", "__init__.py"), re.M).group(1)
    tag, info = "py3-none-" + platform, "cleave-%s.dist-info/" % version
    name = "cleave-%s-%s.whl" % (version, tag)
    files = {key.replace("VERSION", version): value for key, value in files.items()}
    files[info + "METADATA"] = _metadata(version).encode()
    files[info + "WHEEL"] = ("Wheel-Version: 1.0\nGenerator: cleave_wheel\nRoot-Is-Purelib: %s\nTag: %s\n" %
                             ("true" if platform == "any" else "false", tag)).encode()
    if os.path.exists(_LICENCE):
        files[info + "LICENSE"] = _read(_LICENCE).encode()
    record = ""
    with zipfile.ZipFile(os.path.join(folder, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for key, value in files.items():
            entry = zipfile.ZipInfo(key)
            entry.external_attr = (0o100644 if isinstance(value, bytes) else 0o100755) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            if not isinstance(value, bytes):
                with open(value, "rb") as file:
                    value = file.read()
            wheel.writestr(entry, value)
            digest = base64.urlsafe_b64encode(hashlib.sha256(value).digest()).rstrip(b"=").decode()
            record += "%s,sha256=%s,%d\n" % (key, digest, len(value))
        wheel.writestr(info + "RECORD", record + info + "RECORD,,\n")
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel of the module and the program, and returns its name."""
    names = sorted(name for name in os.listdir(os.path.join(_HERE, "cleave")) if name.endswith((".py", ".typed")))
    files = {"cleave/" + name: _read("cleave", name).encode() for name in names}
    built = os.access(_PROGRAM, os.X_OK)
    if built:
        files["cleave-VERSION.data/scripts/cleave"] = _PROGRAM
    return _write(wheel_directory, files, re.sub(r"[-.]", "_", sysconfig.get_platform()) if built else "any")


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes a wheel that leads Python to the module of this checkout, and returns its name (pip install -e)."""
    return _write(wheel_directory, {"cleave.pth": (_HERE + "\n").encode()}, "any")


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("sources are packed by make dist")
