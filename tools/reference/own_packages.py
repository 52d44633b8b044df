# SPDX-License-Identifier: Apache-2.0
"""Tell the packages of this project from those that somebody adds to src/."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

MAINTAINER = 'maintainers@humanoid-workspace.dev'


def is_own_package(folder: Path) -> bool:
    """
    Whether a package's manifest names the project's own maintainer.

    Parameters
    ----------
    folder
        The folder with the package.xml.

    """
    manifest = ElementTree.parse(folder / 'package.xml')
    return any(each.get('email') == MAINTAINER for each in manifest.iter('maintainer'))
