# SPDX-License-Identifier: Apache-2.0
"""Tests of the border: src/ is an ordinary ROS 2 Jazzy workspace, and tools/ its underlay."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
import re
from xml.etree import ElementTree

from own_packages import is_own_package
import pytest

FOREIGN = re.compile(r'\.venv|\btools/|\bunderlay\b|\bwheels?\b|\bPyPI\b|\bpip install\b')
TEXTS = {'.py', '.xml', '.cfg', '.md', '.yaml', '.xacro', '.urdf', '.rviz', '.txt'}
# Packages of ROS 2 Jazzy that launch files and nodes of src/ may import.
JAZZY = set(
    'action_msgs action_tutorials_interfaces ament_copyright ament_flake8 ament_index_python '
    'ament_pep257 audio_common_msgs builtin_interfaces control_msgs controller_manager_msgs '
    'diagnostic_msgs domain_coordinator example_interfaces geographic_msgs geometry_msgs launch '
    'launch_pytest launch_ros launch_testing launch_testing_ros lifecycle_msgs map_msgs '
    'nav2_common nav2_msgs nav2_simple_commander nav_msgs py_trees rcl_interfaces rclpy '
    'rosgraph_msgs sensor_msgs simulation_interfaces slam_toolbox std_msgs std_srvs tf2_msgs '
    'tf2_ros trajectory_msgs unique_identifier_msgs vision_msgs visualization_msgs xacro'.split()
)
LIBRARIES = set(
    'OpenGL cv2 faster_whisper gymnasium httpx httpx2 jsonschema lxml matplotlib mcp mujoco numpy '
    'onnxruntime pinocchio pocketsphinx pyarrow pytest pywhispercpp ray scipy segno setuptools '
    'sounddevice uvicorn yaml yourdfpy'.split()
)
ROOT = Path(__file__).resolve().parents[2]


def sources() -> Iterator[Path]:
    """Yield the text files of src/."""
    for path in sorted((ROOT / 'src').rglob('*')):
        if path.suffix in TEXTS and '__pycache__' not in path.parts:
            yield path


def packages() -> list[Path]:
    """Return the packages of src/."""
    return sorted(path.parent for path in (ROOT / 'src').glob('*/package.xml'))


def test_src_does_not_know_how_ros_was_installed() -> None:
    """No file of src/ names the other layer."""
    found = [
        f'{path.relative_to(ROOT)}: {match.group()}'
        for path in sources()
        if (match := FOREIGN.search(path.read_text()))
    ]
    assert found == []


def test_src_imports_only_what_jazzy_has() -> None:
    """Every import is the standard library, Jazzy, a known library or a package of src/."""
    import sys

    allowed = JAZZY | LIBRARIES | {path.name for path in packages()} | sys.stdlib_module_names
    found = [
        f'{path.relative_to(ROOT)}: {name}'
        for path in sources()
        if path.suffix == '.py'
        for name in sorted(imported(path) - allowed)
    ]
    assert found == []


@cache
def imported(path: Path) -> frozenset[str]:
    """Return the top-level names that a module imports, by absolute name."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.split('.')[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module.split('.')[0])
    return frozenset(names)


def test_tools_do_not_import_src() -> None:
    """The underlay knows nothing of the robot; only benchmarks and training use it."""
    names = {path.name for path in packages()}
    named = re.compile('|'.join(names))  # to parse only files that may import one
    found = [
        f'{path.relative_to(ROOT)}: {name}'
        for path in sorted((ROOT / 'tools').rglob('*.py'))
        if not {'benchmarks', 'training'} & {*path.parts}
        and not path.name.startswith(('test_training', 'test_perception', 'test_whisper'))
        and named.search(path.read_text())
        for name in sorted(imported(path) & names)
    ]
    assert found == []


@pytest.mark.parametrize('package', packages(), ids=lambda path: path.name)
def test_each_package_declares_its_imports(package: Path) -> None:
    """What a package imports stands in its manifest, whoever has made it."""
    manifest = ElementTree.parse(package / 'package.xml').getroot()
    declared = {element.text for element in manifest if element.tag.endswith('depend')}
    used = {name for path in package.rglob('*.py') for name in imported(path)}
    own = {path.name for path in packages()} | JAZZY
    assert (used & own) - {package.name} - declared == set()


@pytest.mark.parametrize('package', filter(is_own_package, packages()), ids=lambda path: path.name)
def test_each_own_package_keeps_the_rules(package: Path) -> None:
    """Manifest of format 3, licence and README are there, and a marker unless CMake makes it."""
    manifest = ElementTree.parse(package / 'package.xml').getroot()
    assert manifest.get('format') == '3'
    assert manifest.findtext('name') == package.name
    assert manifest.findtext('license') == 'Apache-2.0'
    if manifest.findtext('export/build_type') == 'ament_python':
        assert (package / 'resource' / package.name).is_file()
    assert (package / 'README.md').is_file()


def test_there_are_own_packages() -> None:
    """The rules are those of several packages."""
    assert len([path for path in packages() if is_own_package(path)]) > 2
