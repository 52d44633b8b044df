# SPDX-License-Identifier: Apache-2.0
"""Write folders and files, and say so."""

from __future__ import annotations

import os


class Writer:
    """Creates the files of one package below its folder."""

    def __init__(self, package_folder: str) -> None:
        """Create the package's folder."""
        self.package_folder = package_folder
        self._make(package_folder)

    def folder(self, relative: str) -> None:
        """Create a folder, if it does not exist yet."""
        self._make(os.path.join(self.package_folder, relative))

    def file(self, relative: str, text: str = '') -> None:
        """Create a file with its text."""
        path = os.path.join(self.package_folder, relative)
        print(f'creating {path}')
        with open(path, 'w', encoding='utf-8') as stream:
            stream.write(text)

    @staticmethod
    def _make(path: str) -> None:
        if not os.path.isdir(path):
            print(f'creating folder {path}')
            os.makedirs(path)
