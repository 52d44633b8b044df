# SPDX-License-Identifier: Apache-2.0
"""Create the files of a new package."""

from ros2pkg.create.description import PackageDescription
from ros2pkg.create.package import create_package

__all__ = ['PackageDescription', 'create_package']
