# SPDX-License-Identifier: Apache-2.0
"""Create the files of a new package, of any supported build type."""

from __future__ import annotations

from ros2pkg.create import ament_cmake, ament_python
from ros2pkg.create.package import license_text, manifest_text, PackageDescription, Writer

__all__ = ['PackageDescription', 'create_package']

LAYOUTS = {
    'ament_cmake': ament_cmake.write_sources,
    'ament_python': ament_python.write_sources,
}


def create_package(description: PackageDescription, package_folder: str) -> None:
    """
    Create a package: manifest, sources, and the licence if its text is known.

    Parameters
    ----------
    description
        The package; its build type is `ament_cmake` or `ament_python`.
    package_folder
        The folder of the package, which is created, too.

    Raises
    ------
    OSError
        A folder or file cannot be written.

    """
    writer = Writer(package_folder)
    writer.file('package.xml', manifest_text(description))
    LAYOUTS[description.build_type](description, writer)
    text = license_text(description.license_id, description.maintainer_name)
    if text is not None:
        writer.file('LICENSE', text)
