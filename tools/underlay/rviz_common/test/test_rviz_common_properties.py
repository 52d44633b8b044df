# SPDX-License-Identifier: Apache-2.0
"""Properties are read from files, checked, and written back without losses."""

from __future__ import annotations

from typing import Any

import pytest
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Number,
    Property,
    qos_of,
    Text,
    Topic,
    topic_properties,
    Values,
    Vector,
    Whole,
)

SIZE = Number('Size', 1.0, minimum=0.0, maximum=10.0)
STYLE = Choice('Line Style/Value', 'Lines', choices=('Lines', 'Billboards'))
COLOR = ColorOf('Color', (255, 0, 0))
OFFSET = Vector('Offset', (0.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ('kind', 'given', 'value', 'written'),
    [
        (Flag('', False), True, True, True),
        (SIZE, 2, 2.0, 2),
        (SIZE, 0.25, 0.25, 0.25),
        (Whole('', 0), 3, 3, 3),
        (Whole('', 0), 3.0, 3, 3),
        (Text('', ''), 5, '5', '5'),
        (Text('', ''), None, '', ''),
        (Topic('', ''), '/scan', '/scan', '/scan'),
        (STYLE, 'Billboards', 'Billboards', 'Billboards'),
        (COLOR, '1; 2; 255', (1, 2, 255), '1; 2; 255'),
        (COLOR, (1, 2, 3), (1, 2, 3), '1; 2; 3'),
        (OFFSET, {'X': 1, 'Y': 0, 'Z': -0.5}, (1.0, 0.0, -0.5), {'X': 1, 'Y': 0, 'Z': -0.5}),
        (OFFSET, {'X': 1}, (1.0, 0.0, 0.0), {'X': 1, 'Y': 0, 'Z': 0}),
        (OFFSET, (1, 2, 3), (1.0, 2.0, 3.0), {'X': 1, 'Y': 2, 'Z': 3}),
    ],
)
def test_read_and_write(kind: Property, given: Any, value: Any, written: Any) -> None:
    """A value of a file or a widget is read, and written as RViz does."""
    assert kind.read(given) == value
    assert kind.write(value) == written
    assert type(kind.write(value)) is type(written)


@pytest.mark.parametrize(
    ('kind', 'given', 'reason'),
    [
        (Flag('', False), 'yes', "must be true or false, not 'yes'"),
        (Flag('', False), 1, "must be true or false, not '1'"),
        (SIZE, 'big', "must be a number, not 'big'"),
        (SIZE, True, "must be a number, not 'True'"),
        (SIZE, float('nan'), 'must be a number'),
        (SIZE, -1, 'must be from 0 to 10, not -1'),
        (SIZE, float('inf'), 'must be from 0 to 10, not inf'),
        (Whole('', 0), 1.5, 'must be a whole number, not 1.5'),
        (STYLE, 'Dots', "must be one of Lines, Billboards, not 'Dots'"),
        (COLOR, 'red', "must be like '255; 0; 0', not 'red'"),
        (COLOR, '1; 2', "must be like '255; 0; 0'"),
        (COLOR, '1; 2; 256', 'must have numbers from 0 to 255'),
        (COLOR, 5, "must be like '255; 0; 0', not '5'"),
        (OFFSET, {'X': 'a'}, 'must be three numbers'),
        (OFFSET, (1, 2), 'must be three numbers'),
        (OFFSET, 7, 'must be three numbers'),
        (OFFSET, (1, 2, float('inf')), 'must be three finite numbers'),
    ],
)
def test_refused(kind: Property, given: Any, reason: str) -> None:
    """A value that a property cannot have is refused with the reason."""
    with pytest.raises(ValueError) as error:
        kind.read(given)
    assert reason in str(error.value)


def test_values() -> None:
    """Values of the file count, the others have their defaults, and nesting is as in the file."""
    values = Values((SIZE, STYLE), {'Line Style': {'Value': 'Billboards'}})
    assert (values['Size'], values['Line Style/Value']) == (1.0, 'Billboards')


def test_refused_values_have_defaults() -> None:
    """A value that cannot be used is named, and the default counts."""
    values = Values((SIZE, COLOR), {'Size': -3, 'Color': '1; 2; 3'})
    assert values.refusals == ["'Size' must be from 0 to 10, not -3."]
    assert (values['Size'], values['Color']) == (1.0, (1, 2, 3))


def test_write_back() -> None:
    """What the file had besides is kept, in its order, with the values as they are now."""
    given = {
        'Strange': {'a': [1]},
        'Line Style': {'Value': 'Lines', 'Line Width': 0.03},
        'Size': 2,
    }
    values = Values((SIZE, STYLE), given)
    assert values.to_file() == given
    values['Size'] = 2.5
    values['Line Style/Value'] = 'Billboards'
    written = values.to_file()
    assert list(written) == ['Strange', 'Line Style', 'Size']
    assert written['Line Style'] == {'Value': 'Billboards', 'Line Width': 0.03}
    assert (written['Size'], given['Size']) == (2.5, 2)


def test_wrong_shape_of_file() -> None:
    """A text where others nest gives defaults; a change is written in the right shape."""
    values = Values((STYLE,), {'Line Style': 'Billboards'})
    assert values['Line Style/Value'] == 'Lines'
    values['Line Style/Value'] = 'Billboards'
    assert values.to_file() == {'Line Style': {'Value': 'Billboards'}}


def test_unknown() -> None:
    """Only what nobody knows is named as unknown."""
    values = Values((SIZE, STYLE), {'Size': 1, 'Line Style': {}, 'Name': 'x', 'Shine': 1})
    assert values.unknown(['Name']) == ['Shine']


def test_refused_change() -> None:
    """A refused change leaves the value as it was."""
    values = Values((SIZE,), {'Size': 2})
    with pytest.raises(ValueError, match='must be from'):
        values['Size'] = 11
    assert values['Size'] == 2.0


def test_qos() -> None:
    """The quality of service is the one that the file asks for."""
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, ReliabilityPolicy

    topic = {
        'Value': '/map',
        'Depth': 3,
        'Durability Policy': 'Transient Local',
        'Reliability Policy': 'Best Effort',
    }
    values = Values(topic_properties('nav_msgs/msg/OccupancyGrid'), {'Topic': topic})
    qos = qos_of(values)
    assert values['Topic/Value'] == '/map'
    assert (qos.depth, qos.durability) == (3, DurabilityPolicy.TRANSIENT_LOCAL)
    assert (qos.reliability, qos.history) == (
        ReliabilityPolicy.BEST_EFFORT,
        HistoryPolicy.KEEP_LAST,
    )
