# SPDX-License-Identifier: Apache-2.0
"""The underlay in the environment: the selection and build of its packages."""

from __future__ import annotations

from functools import cached_property

import colcon
from console import Steps
from described import describe, forget
from locations import Locations
from packages import needed, Package, read_packages
from stamp import digest, files_below, Stamp


class Underlay:
    """
    The packages of tools/underlay, each with a stamp once it is built into the environment.

    An interface package that nothing in src/ depends on is deferred until everything is requested,
    and a package on demand until it, or everything, is. Until then it is only described, so that
    `ros2` finds and shows it, and importing it reports what to do. A package that was built before
    is kept up to date.

    Parameters
    ----------
    locations
        The workspace and its environment.
    requirements
        The digest of the wheels that the packages build on.
    asked_for
        The arguments of the command, which may name what is only built on demand.

    """

    def __init__(self, locations: Locations, requirements: str, asked_for: str = '') -> None:
        self._locations = locations
        self._asked_for = asked_for
        self._packages = read_packages(locations.underlay)
        self._requirements = requirements
        self._digests: dict[str, str] = {}

    def to_build(self, *, everything: bool) -> list[str]:
        """
        List the packages that are wanted and not built, or built from other sources.

        Parameters
        ----------
        everything
            Whether all packages are wanted; otherwise, those that the command needs and those that
            were built before.

        Returns
        -------
        list of str
            Their names, sorted.

        """
        wanted = set(self._packages) if everything else self._wanted()
        return sorted(name for name in wanted if not self._stamp(name).matches(self._digest(name)))

    def build(self, names: list[str], steps: Steps) -> None:
        """
        Build packages; one left incomplete by an interruption is rebuilt the next time.

        Parameters
        ----------
        names
            The names of the packages.
        steps
            Shows the progress.

        Raises
        ------
        SetupError
            The build failed.

        """
        for name in names:
            self._stamp(name).clear()
            self._stamp(name, 'described').clear()

        def finished(name: str) -> None:
            self._stamp(name).write(self._digest(name))
            forget(self._packages[name], self._locations)

        changed = [self._packages[name] for name in names]
        colcon.remove_outdated_modules(changed, self._locations.environment / 'build')
        waiting = sorted(set(self._packages) - self._wanted() - {*names})
        colcon.build_underlay(self._locations, steps, names, waiting, finished)

    def describe_others(self) -> None:
        """Describe the deferred packages, unless already done."""
        for name in sorted(set(self._packages) - self._wanted()):
            stamp = self._stamp(name, 'described')
            if not stamp.matches(self._digest(name)):
                describe(self._packages[name], self._locations)
                stamp.write(self._digest(name))

    @cached_property
    def _needed(self) -> set[str]:
        workspace = read_packages(self._locations.root / 'src')
        return needed(self._packages, workspace, self._asked_for)

    def _wanted(self) -> set[str]:
        built = {name for name in self._packages if self._stamp(name).exists()}
        return self._needed | built

    def _stamp(self, name: str, kind: str = 'underlay_packages') -> Stamp:
        return Stamp(self._locations.environment / 'stamp' / kind / name)

    def _digest(self, name: str) -> str:
        if name not in self._digests:
            self._digests[name] = self._compute_digest(self._packages[name])
        return self._digests[name]

    def _compute_digest(self, package: Package) -> str:
        """Return the digest of the sources of a package, for interfaces with dependencies."""
        if not package.is_interface:
            return digest(files_below(package.folder), self._requirements)
        others = sorted(name for name in package.depends_on if name in self._packages)
        files = [*files_below(package.folder), str(self._locations.root / 'colcon.meta')]
        return digest(files, self._requirements, *map(self._digest, others))
