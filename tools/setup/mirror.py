# SPDX-License-Identifier: Apache-2.0
"""A folder with all pinned wheels, from which machines without internet set the workspace up."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import os
from pathlib import Path
import re
from tempfile import TemporaryDirectory

from console import SetupError, Steps
from locations import expanded_path, Locations
from processes import environment_variables, last_words, run_logged
import wheels

VERSIONS = ('3.10', '3.11', '3.12', '3.13')
"""The versions of Python for which the wheels of ROS 2 exist."""
PLATFORMS = [f'manylinux_2_{minor}_x86_64' for minor in range(28, 4, -1)] + [
    *(f'manylinux{name}_x86_64' for name in ('2014', '2010', '1')),
    'linux_x86_64',
]
"""What runs with glibc 2.28, the oldest that the workspace supports."""
_LINE = re.compile(
    r'(?P<pin>\S+==\S+)'
    r"(?: ; python_full_version (?P<order><|>=|==) '(?P<version>3\.\d+)(?:\.\*)?')?"
)


def pins_for(requirements: str, version: str) -> list[str]:
    """
    Select the pins of a requirements file for a version of Python.

    pip itself judges the conditions of the lines by the Python in which it runs.

    Parameters
    ----------
    requirements
        The text of the file.
    version
        The version, such as 3.12.

    Returns
    -------
    list of str
        The pins, without their conditions.

    Raises
    ------
    SetupError
        A line has another form than `make lock` writes.

    """
    found: dict[str, None] = {}
    for line in requirements.splitlines():
        if not line.strip() or line.startswith('#'):
            continue
        match = _LINE.fullmatch(line)
        if match is None:
            raise SetupError(f'This line of the requirements is not understood: {line}')
        if match['order'] is None or _holds(version, match['order'], match['version']):
            found[match['pin']] = None
    return list(found)


def _holds(version: str, order: str, limit: str) -> bool:
    left, right = (tuple(map(int, text.split('.'))) for text in (version, limit))
    return {'<': left < right, '>=': left >= right, '==': left == right}[order]


def versions_of(text: str) -> list[str]:
    """
    Parse the versions of Python for which wheels are wanted.

    Parameters
    ----------
    text
        The versions, separated by spaces or commas; '' for all.

    Raises
    ------
    SetupError
        There are no wheels of ROS 2 for one of them.

    """
    versions = text.replace(',', ' ').split() or list(VERSIONS)
    for version in versions:
        if version not in VERSIONS:
            raise SetupError(
                f"There are no wheels for Python '{version}': choose among {', '.join(VERSIONS)}, "
                "as in PYTHONS='3.12 3.13'"
            )
    return versions


def make_mirror(
    locations: Locations, folder: Path, requirements: Sequence[Path], versions: Sequence[str]
) -> None:
    """
    Download all pinned wheels into a folder; what is there already is not downloaded again.

    Parameters
    ----------
    locations
        The workspace and its environment, whose pip is used.
    folder
        Where to put the wheels.
    requirements
        The files that pin them.
    versions
        The versions of Python for which they are wanted.

    Raises
    ------
    SetupError
        There is no environment yet, or pip failed.

    """
    if not wheels.has_pip(locations):
        raise SetupError('The download uses the pip of the environment: run `make setup` first')
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'COLCON_IGNORE').touch()
    texts = [path.read_text(encoding='utf-8') for path in requirements]
    steps = Steps(len(versions) + 1)
    for version in versions:
        pins = [
            pin
            for pin in pins_for('\n'.join(texts), version)
            if not any(folder.glob(f'{_stem(pin)}-py3-none-any.whl'))
        ]
        steps.begin(f'{len(pins)} wheels for Python {version}')
        _download(locations, folder, pins, version)
    steps.begin('Wheels of what PyPI has as source only')
    for archive in sorted([*folder.glob('*.tar.gz'), *folder.glob('*.zip')]):
        _pip(locations, ['wheel', '--no-deps', '--wheel-dir', str(folder), str(archive)])
        archive.unlink()
    steps.end()


def _stem(pin: str) -> str:
    """Return how the name of a wheel begins: for `Types-PyYAML==6.0`, `types_pyyaml-6.0`."""
    name, _, version = pin.partition('==')
    return f'{re.sub(r"[-_.]+", "_", name).lower()}-{version}'


def _download(locations: Locations, folder: Path, pins: Iterable[str], version: str) -> None:
    platforms = [word for name in PLATFORMS for word in ('--platform', name)]
    with TemporaryDirectory() as place:
        listed = Path(place) / 'requirements.txt'
        listed.write_text('\n'.join(pins) + '\n', encoding='utf-8')
        words = ['download', '--no-deps', '--progress-bar', 'off', '--dest', str(folder)]
        target = ['--implementation', 'cp', '--python-version', version, *platforms]
        _pip(locations, [*words, '--requirement', str(listed), *target])


def _pip(locations: Locations, arguments: Sequence[str]) -> None:
    log = locations.environment / 'log' / 'pip_mirror.log'
    status = run_logged(
        [locations.python, *wheels.PIP, *arguments],
        cwd=locations.root,
        variables=environment_variables(locations.environment),
        log=log,
    )
    if status != 0:
        raise SetupError(
            f'pip could not download the wheels (the full output is in {log}):\n'
            f'{last_words(log, "ERROR")}\n'
            'Fix that (network, proxy, disk) and run the same command again: it continues there'
        )


def use_mirror(folder: str) -> None:
    """
    Have pip take wheels from a folder only, through its own environment variables.

    Parameters
    ----------
    folder
        The folder, as the user named it.

    Raises
    ------
    SetupError
        There are no wheels in it, or it is in a home folder that does not exist.

    """
    path = expanded_path(folder).resolve()
    if not any(path.glob('*.whl')):
        raise SetupError(
            f'There are no wheels in {path}: make them on a machine with internet, with '
            f'`make mirror WHEELS={folder}`, and copy the folder'
        )
    os.environ['PIP_NO_INDEX'] = '1'
    os.environ['PIP_FIND_LINKS'] = path.as_uri()  # pip splits paths with spaces
