# SPDX-License-Identifier: Apache-2.0
"""
The interface packages of the underlay have the types that ROS 2 Jazzy has, and all of them work.

`interfaces/PACKAGE.txt` says which fields each type has, in their order, as published: who adds
or changes a type writes that down there, apart from the definition. Names, types and order of
fields are what a type's hash is made from.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from random import Random
import re
from typing import Any

from ament_index_python import get_package_share_directory, get_resource
import numpy as np
import pytest
from random_messages import ros_message
from rclpy.serialization import deserialize_message, serialize_message

TABLES = sorted((Path(__file__).parent / 'interfaces').glob('*.txt'))
UNDERLAY = Path(__file__).resolve().parents[1] / 'underlay'
PARTS = {'msg': [''], 'srv': ['Request', 'Response'], 'action': ['Goal', 'Result', 'Feedback']}
IN_PYTHON = {
    'bool': 'boolean',
    'byte': 'octet',
    'char': 'uint8',
    'float32': 'float',
    'float64': 'double',
}
FIELD = re.compile(r'(?P<kind>[\w/]+)(?P<many>\[(?P<size>\d*)\])? (?P<name>\w+)')


def rows() -> Iterator[tuple[str, str, str, list[str]]]:
    """Yield package, kind (msg, srv, action), name and the fields of each part of each type."""
    for table in TABLES:
        for line in table.read_text().splitlines():
            if not line.startswith('#'):
                place, _, fields = line.partition(':')
                kind, _, name = place.partition('/')
                yield table.stem, kind, name, [part.strip() for part in fields.split('|')]


def in_python(fields: str, package: str) -> dict[str, str]:
    """Return the names and types of fields as a message's class tells them."""
    found = {}
    for field in FIELD.finditer(fields):
        kind = IN_PYTHON.get(field['kind'], field['kind'])
        if kind[0].isupper():
            kind = f'{package}/{kind}'
        if field['many']:
            kind = f'{kind}[{field["size"]}]' if field['size'] else f'sequence<{kind}>'
        found[field['name']] = kind
    return found


def test_every_interface_package_has_a_table() -> None:
    """The packages that ROS 2 Jazzy has and PyPI lacks, whole."""
    assert [table.stem for table in TABLES] == (
        'ackermann_msgs action_tutorials_interfaces audio_common_msgs control_msgs '
        'controller_manager_msgs example_interfaces geographic_msgs map_msgs nav2_msgs '
        'rosbag2_interfaces simulation_interfaces turtlesim vision_msgs'.split()
    )


@pytest.mark.parametrize('package', [table.stem for table in TABLES])
def test_the_package_has_these_types_and_no_others(package: str) -> None:
    """What is in the table is in the sources and in the index of what is installed."""
    known = sorted(f'{kind}/{name}.{kind}' for owner, kind, name, _ in rows() if owner == package)
    files = UNDERLAY.joinpath(package).glob('*/*.*')
    written = [f'{path.parent.name}/{path.name}' for path in files]
    assert sorted(name for name in written if name[:3] in ('msg', 'srv', 'act')) == known
    content, _ = get_resource('rosidl_interfaces', package)
    assert sorted(name for name in content.split() if not name.endswith('.idl')) == known
    share = Path(get_package_share_directory(package))
    assert [name for name in known if not (share / name).is_file()] == []


@pytest.mark.parametrize(
    ('package', 'kind', 'name', 'parts'), rows(), ids=lambda value: str(value)[:40]
)
def test_a_type_is_as_published_and_works(
    package: str, kind: str, name: str, parts: list[str]
) -> None:
    """Fields are those of the table, in order; random messages survive being sent."""
    whole: Any = getattr(import_module(f'{package}.{kind}'), name)
    assert len(parts) == len(PARTS[kind])
    for part, fields in zip(PARTS[kind], parts):
        message_type = getattr(whole, part) if part else whole
        wanted = in_python(fields, package)
        assert list(message_type.get_fields_and_field_types().items()) == list(wanted.items())
        for seed in range(3):
            message = ros_message(message_type, Random(seed))
            again = deserialize_message(serialize_message(message), message_type)
            assert plain(again) == plain(message)


def plain(value: Any) -> Any:
    """Return a message as texts, numbers with the digits that each type of them has."""
    if hasattr(value, 'get_fields_and_field_types'):
        names = value.get_fields_and_field_types()
        return {name: plain(getattr(value, name)) for name in names}
    if isinstance(value, (float, np.floating)):
        with np.errstate(over='ignore'):
            return str(np.float32(value))
    if isinstance(value, (str, int, np.integer)):
        return value
    return [plain(each) for each in value]


def test_action_types_have_their_services() -> None:
    """An action client needs the type support of what is around goal, result and feedback."""
    from nav2_msgs.action import NavigateToPose

    goal = NavigateToPose.Impl.SendGoalService.Request(
        goal=NavigateToPose.Goal(behavior_tree='tree.xml')
    )
    again = deserialize_message(serialize_message(goal), type(goal))
    assert again == goal
