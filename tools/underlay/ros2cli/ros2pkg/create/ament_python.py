# SPDX-License-Identifier: Apache-2.0
"""The files of a Python package."""

from __future__ import annotations

from ros2pkg.create.package import PackageDescription, Writer

SETUP_PY = """\
from setuptools import find_packages, setup

package_name = {name!r}

setup(
    name=package_name,
    version={version!r},
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={maintainer_name!r},
    maintainer_email={maintainer_email!r},
    description={description!r},
    license={license_id!r},
    extras_require={{
        'test': ['pytest'],
    }},
    entry_points={{
        'console_scripts': [{entries}
        ],
    }},
)
"""

SETUP_CFG = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""

NODE = """\
def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""

FLAKE8 = """\
from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    rc, errors = main_with_errors(argv=[])
    assert rc == 0, f'{len(errors)} code style errors or warnings:\\n' + '\\n'.join(errors)
"""

PEP257 = """\
from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found code style errors or warnings'
"""

COPYRIGHT = """\
from ament_copyright.main import main
import pytest


# Remove the `skip` decorator once the source files have a copyright header.
@pytest.mark.skip(reason='The generated source files have no copyright header yet.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found errors'
"""

TESTS = {
    'test_copyright.py': COPYRIGHT,
    'test_flake8.py': FLAKE8,
    'test_pep257.py': PEP257,
}


def write_sources(description: PackageDescription, writer: Writer) -> None:
    """
    Write the files of an ament_python package, except for its manifest and licence.

    Parameters
    ----------
    description
        The package; a node gets a module and an entry point, a library a package of its own.
    writer
        Writes below the package's folder.

    """
    name = description.name
    print('creating source folder')
    writer.folder(name)
    writer.file('setup.py', _setup_py(description))
    writer.file('setup.cfg', SETUP_CFG.format(name=name))
    writer.folder('resource')
    writer.file(f'resource/{name}')
    writer.file(f'{name}/__init__.py')
    writer.folder('test')
    for test, text in TESTS.items():
        writer.file(f'test/{test}', text)
    if description.library_name:
        writer.folder(f'{name}/{description.library_name}')
        writer.file(f'{name}/{description.library_name}/__init__.py')
    if description.node_name:
        writer.file(f'{name}/{description.node_name}.py', NODE.format(name=name))


def _setup_py(description: PackageDescription) -> str:
    node = description.node_name
    entry = f"\n            '{node} = {description.name}.{node}:main'," if node else ''
    text = SETUP_PY.format(**description._asdict(), entries=entry)
    return '\n'.join(_excused(line) for line in text.split('\n'))


def _excused(line: str) -> str:
    """Append a `noqa` mark to a line that exceeds the line length of the linter."""
    return f'{line}  # noqa: E501' if len(line) > 99 else line
