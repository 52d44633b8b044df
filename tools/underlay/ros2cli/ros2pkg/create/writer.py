# SPDX-License-Identifier: Apache-2.0
"""Write folders and files, and report each."""

from __future__ import annotations

import os


class Writer:
    """
    Writer that creates the folders and files of a package, and prints the path of each.

    Parameters
    ----------
    package_folder
        The folder of the package, which is created if need be.

    Raises
    ------
    OSError
        The folder cannot be created.

    """

    def __init__(self, package_folder: str) -> None:
        self.package_folder = package_folder
        self._make(package_folder)

    def folder(self, relative: str) -> None:
        """
        Create a folder and its parents, unless it exists.

        Parameters
        ----------
        relative
            Path from the package's folder.

        Raises
        ------
        OSError
            The folder cannot be created.

        """
        self._make(os.path.join(self.package_folder, relative))

    def file(self, relative: str, text: str = '') -> None:
        """
        Write a text file, in a folder that exists.

        Parameters
        ----------
        relative
            Path from the package's folder.
        text
            The content, written as UTF-8.

        Raises
        ------
        OSError
            The file cannot be written.

        """
        path = os.path.join(self.package_folder, relative)
        print(f'creating {path}')
        with open(path, 'w', encoding='utf-8') as stream:
            stream.write(text)

    @staticmethod
    def _make(path: str) -> None:
        if not os.path.isdir(path):
            print(f'creating folder {path}')
            os.makedirs(path)
