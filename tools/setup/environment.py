# SPDX-License-Identifier: Apache-2.0
"""Bring an environment up to date: for the workspace, tests, clusters, and the site."""

from __future__ import annotations

import os
from pathlib import Path
import sys
import sysconfig

from console import SetupError, Steps
from locations import link_environment, Locations
from ownership import Home, python_version
from parts import Parts
import prerequisites
import processes
from stamp import digest, Stamp
from underlay import Underlay
import wheels

ROOT = Path(__file__).resolve().parents[2]
REQUIREMENTS = ROOT / 'requirements.txt'
PART_REQUIREMENTS = ROOT / 'requirements-parts.txt'
CLUSTER_REQUIREMENTS = ROOT / 'requirements-cluster.txt'
TEST_REQUIREMENTS = ROOT / 'requirements-test.txt'
SITE_REQUIREMENTS = ROOT / 'requirements-site.txt'


def set_up(locations: Locations, *, quiet: bool = False, everything: bool = True) -> int:
    """
    Bring the environment up to date with this workspace; quick if it already is.

    Parameters
    ----------
    locations
        The workspace and its environment.
    quiet
        Print nothing if the environment is complete, and no hint at the end.
    everything
        Install everything; otherwise defer what the command does not need: interface packages that
        nothing in src/ depends on, and packages on demand and wheels of parts that ASKED_FOR does
        not name.

    Returns
    -------
    int
        The exit status, 0.

    Raises
    ------
    SetupError
        The machine lacks something, a step failed, or another workspace owns the environment.

    """
    requirements = wheels_digest(REQUIREMENTS)
    wheels_stamp = Stamp(locations.environment / 'stamp' / 'wheels')
    asked_for = os.environ.get('ASKED_FOR', '')
    underlay = Underlay(locations, requirements, asked_for)
    parts = Parts(locations, PART_REQUIREMENTS, asked_for)
    cluster = cluster_parts(locations)
    home = Home(locations)
    home.require_same()
    stale = underlay.to_build(everything=everything)
    missing = parts.to_install(everything=everything)
    outdated = cluster.to_install(everything=False)
    compiled = wheels_digest(REQUIREMENTS, PART_REQUIREMENTS)
    compiled_stamp = Stamp(locations.environment / 'stamp' / 'compiled')
    is_compiled = not everything or compiled_stamp.matches(compiled)
    has_wheels = wheels_stamp.matches(requirements)
    is_complete = has_wheels and is_compiled and not (missing or outdated or stale)
    if locations.link.exists() and is_complete:
        link_environment(locations)
        underlay.describe_others()
        parts.describe_others()
        cluster.describe_others()
        if not quiet:
            print(f'The environment in {locations.link} is complete.')
        return 0
    require_machine(locations, has_wheels=has_wheels)
    steps = Steps(3)
    steps.begin(f'Python {python_version()} environment in {locations.environment}')
    locations.environment.mkdir(parents=True, exist_ok=True)
    home.write()
    link_environment(locations)
    if not wheels.has_pip(locations):
        wheels.make_environment(locations, sys.executable)
    steps.begin('Wheels from PyPI, as requirements.txt and requirements-parts.txt pin them')
    if not has_wheels:
        wheels_stamp.clear()
        wheels.install_wheels(locations, steps, sysconfig.get_path('include'), REQUIREMENTS)
        wheels_stamp.write(requirements)
    parts.install(missing, steps)
    parts.describe_others()
    cluster.install(outdated, steps)
    cluster.describe_others()
    if not is_compiled:
        wheels.compile_all(locations)
        compiled_stamp.write(compiled)
    steps.begin('Underlay: launch, ros2 and what else PyPI lacks (a minute)')
    underlay.build(stale, steps)
    underlay.describe_others()
    steps.end()
    print('The environment is complete.' + ('' if quiet else ' Next: make bringup'))
    return 0


def cluster_parts(locations: Locations) -> Parts:
    """
    Return what only sweeps on several machines need, which `make cluster` installs.

    Parameters
    ----------
    locations
        The workspace and its environment.

    """
    return Parts(locations, CLUSTER_REQUIREMENTS, command='make cluster')


def set_up_cluster(locations: Locations) -> int:
    """
    Install the wheels of requirements-cluster.txt, which only sweeps on several machines need.

    Parameters
    ----------
    locations
        The workspace and its environment, which is complete except for them.

    Returns
    -------
    int
        The exit status, 0.

    Raises
    ------
    SetupError
        The wheels could not be installed.

    """
    cluster = cluster_parts(locations)
    missing = cluster.to_install(everything=True)
    if missing:
        steps = Steps(1)
        steps.begin('Ray from PyPI, as requirements-cluster.txt pins it')
        cluster.install(missing, steps)
        steps.end()
    print('Ray is installed.')
    return 0


def set_up_tests(locations: Locations) -> int:
    """
    Install the wheels of requirements-test.txt, which only tests need.

    Parameters
    ----------
    locations
        The workspace and its environment, which is complete except for them.

    Returns
    -------
    int
        The exit status, 0.

    """
    current = wheels_digest(REQUIREMENTS, TEST_REQUIREMENTS)
    stamp = Stamp(locations.environment / 'stamp' / 'tests')
    if not stamp.matches(current):
        steps = Steps(1)
        steps.begin('Libraries that tests compare ours with')
        stamp.clear()
        include = sysconfig.get_path('include')
        wheels.install_wheels(locations, steps, include, TEST_REQUIREMENTS)
        wheels.compile_all(locations)
        stamp.write(current)
        steps.end()
    return 0


def build_site(locations: Locations) -> int:
    """
    Build the documentation as a site, in an environment of its own, which needs no compiler.

    Parameters
    ----------
    locations
        The workspace and its environment, which need not exist yet: that of the site is in it.

    Returns
    -------
    int
        The exit status of the build.

    Raises
    ------
    SetupError
        A wheel could not be installed, or another workspace owns the environment.

    """
    home = Home(locations)
    home.require_same()
    folder = locations.environment / 'site'
    own = Locations(locations.root, folder, folder)
    current = digest([SITE_REQUIREMENTS])
    stamp = Stamp(folder / 'stamp')
    if not stamp.matches(current):
        steps = Steps(1)
        steps.begin('Sphinx and its theme from PyPI, as requirements-site.txt pins them')
        stamp.clear()
        folder.mkdir(parents=True, exist_ok=True)
        home.write()
        link_environment(locations)
        if not wheels.has_pip(own):
            wheels.make_environment(own, sys.executable)
        wheels.fetch_wheels(own, steps, SITE_REQUIREMENTS)
        stamp.write(current)
        steps.end()
    print('Building the site: about a minute', flush=True)
    return processes.run(
        [own.python, ROOT / 'tools' / 'site' / 'build.py'],
        cwd=locations.root,
        variables=processes.without_inherited(),
    )


def wheels_digest(*requirements: Path) -> str:
    """
    Compute the digest of the pinned wheels, and of the patches to them.

    Parameters
    ----------
    *requirements
        The requirements files that pin the wheels.

    Returns
    -------
    str
        A SHA-256 digest in hexadecimal.

    """
    mends = [ROOT / 'tools' / 'setup' / name for name in ('mend.py', 'fast_dds.py')]
    return digest([*requirements, *mends])


def require_machine(locations: Locations, *, has_wheels: bool) -> None:
    """
    Check that the machine meets all requirements, before anything is downloaded.

    Parameters
    ----------
    locations
        The workspace and its environment.
    has_wheels
        Whether the wheels are installed already, so that less disk space is needed.

    Raises
    ------
    SetupError
        Something is missing; the message lists all of it.

    """
    root, environment = os.fspath(locations.root), os.fspath(locations.environment)
    missing = prerequisites.problems(root, environment, has_wheels=has_wheels)
    if missing:
        raise SetupError('\n'.join(missing))
