# SPDX-License-Identifier: Apache-2.0
"""Description of the package to create."""

from __future__ import annotations

from typing import NamedTuple


class PackageDescription(NamedTuple):
    """All properties of a new package."""

    name: str
    package_format: int
    build_type: str
    description: str
    license_id: str
    maintainer_name: str
    maintainer_email: str
    dependencies: tuple[str, ...] = ()
    node_name: str | None = None
    library_name: str | None = None
    version: str = '0.0.0'

    def summary(self, destination: str) -> str:
        """
        Summarize the package for the user before it is created.

        Parameters
        ----------
        destination
            The folder in which the folder of the package is created.

        Returns
        -------
        str
            Several lines, one per property.

        """
        maintainer = f'{self.maintainer_name} <{self.maintainer_email}>'
        lines = [
            f'package name: {self.name}',
            f'destination directory: {destination}',
            f'package format: {self.package_format}',
            f'version: {self.version}',
            f'description: {self.description}',
            f'maintainer: {[maintainer]}',
            f'licenses: {[self.license_id]}',
            f'build type: {self.build_type}',
            f'dependencies: {list(self.dependencies)}',
        ]
        lines += [f'node_name: {self.node_name}'] if self.node_name else []
        lines += [f'library_name: {self.library_name}'] if self.library_name else []
        return '\n'.join(lines)
