# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg xml`."""

from __future__ import annotations

import argparse
from pathlib import Path
from xml.etree import ElementTree

from ros2pkg.api import get_share_directory, missing_package, PackageNotFoundError
from ros2pkg.verb import VerbExtension


class XmlVerb(VerbExtension):
    """Output the XML of the package manifest or a specific tag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the package and the option for a single tag.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 pkg xml`; unused.

        """
        parser.add_argument('package_name', help='The package name')
        parser.add_argument('-t', '--tag', help='The XML tag to output')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the manifest, or the text of each of its top-level elements with the tag.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if the package, its manifest or the tag is missing, or it is not XML.

        """
        try:
            manifest = Path(get_share_directory(args.package_name), 'package.xml')
        except PackageNotFoundError:
            return missing_package(args.package_name)
        if not manifest.is_file():
            return 'Package XML manifest not found'
        try:
            root = ElementTree.parse(manifest).getroot()
        except ElementTree.ParseError as error:
            return f"'{manifest}' is not valid XML: {error}"
        if args.tag is None:
            print(ElementTree.tostring(root, encoding='unicode'))
            return None
        texts = [element.text or '' for element in root if element.tag == args.tag]
        if not texts:
            return 'XML tag not found'
        print('\n'.join(texts))
        return None
