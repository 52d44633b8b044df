# SPDX-License-Identifier: Apache-2.0
"""The description of a new package, and the files that all packages get: manifest and licence."""

from __future__ import annotations

from datetime import date
import os
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr

PYTHON_TESTS = ('ament_copyright', 'ament_flake8', 'ament_pep257', 'python3-pytest')
SCHEMA = 'http://download.ros.org/schema/package_format{}.xsd'
TEXTS = Path(__file__).parent / 'license_texts'


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


def manifest_text(description: PackageDescription) -> str:
    """
    Generate the content of `package.xml`.

    Parameters
    ----------
    description
        The package.

    """
    groups = [_facts(description), _dependencies(description), _tests(description)]
    body = '\n\n'.join('\n'.join(f'  {line}' for line in group) for group in groups if group)
    schema = SCHEMA.format(description.package_format)
    return (
        '<?xml version="1.0"?>\n'
        f'<?xml-model href="{schema}" schematypens="http://www.w3.org/2001/XMLSchema"?>\n'
        f'<package format="{description.package_format}">\n{body}\n\n'
        f'  <export>\n    <build_type>{description.build_type}</build_type>\n  </export>\n'
        '</package>\n'
    )


def _facts(description: PackageDescription) -> list[str]:
    email = quoteattr(description.maintainer_email)
    return [
        _element('name', description.name),
        _element('version', description.version),
        _element('description', description.description),
        f'<maintainer email={email}>{escape(description.maintainer_name)}</maintainer>',
        _element('license', description.license_id),
    ]


def _dependencies(description: PackageDescription) -> list[str]:
    tools = ['ament_cmake'] if description.build_type == 'ament_cmake' else []
    return [
        *(_element('buildtool_depend', name) for name in tools),
        *(_element('depend', name) for name in description.dependencies),
    ]


def _tests(description: PackageDescription) -> list[str]:
    names = PYTHON_TESTS if description.build_type == 'ament_python' else ()
    return [_element('test_depend', name) for name in names]


def _element(tag: str, text: str) -> str:
    return f'<{tag}>{escape(text)}</{tag}>'


def known_licenses() -> list[str]:
    """Return the SPDX identifiers of all licences with a text, sorted."""
    return sorted(path.stem for path in TEXTS.glob('*.txt'))


def license_text(identifier: str, holder: str) -> str | None:
    """
    Load the text of a licence.

    Parameters
    ----------
    identifier
        Its SPDX identifier.
    holder
        The copyright holder; with the current year, it is filled into MIT and BSD licences.

    Returns
    -------
    str or None
        The text, or None for an unknown licence.

    """
    if identifier not in known_licenses():
        return None
    text = (TEXTS / f'{identifier}.txt').read_text(encoding='utf-8')
    if identifier.startswith(('MIT', 'BSD')):
        text = text.replace('<year>', str(date.today().year)).replace('<holder>', holder)
    return text


def unknown_license_warning(identifier: str) -> str:
    """
    Format the warning about an unknown licence, with a list of the known ones.

    Parameters
    ----------
    identifier
        The licence as the user wrote it.

    """
    choices = '\n'.join(known_licenses())
    return (
        f"\n[WARNING]: Unknown license '{identifier}'.  This has been set in the package.xml, "
        'but no LICENSE file has been created.\n'
        f'It is recommended to use one of the ament license identifiers:\n{choices}'
    )


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
