# SPDX-License-Identifier: Apache-2.0
"""The text of package.xml."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from ros2pkg.create.description import PackageDescription

PYTHON_TESTS = ('ament_copyright', 'ament_flake8', 'ament_pep257', 'python3-pytest')
SCHEMA = 'http://download.ros.org/schema/package_format{}.xsd'


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
