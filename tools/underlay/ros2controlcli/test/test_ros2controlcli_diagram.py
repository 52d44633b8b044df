# SPDX-License-Identifier: Apache-2.0
"""Tests of the diagram of controllers."""

from __future__ import annotations

from xml.etree import ElementTree

from controller_manager_msgs.msg import (
    ChainConnection,
    ControllerState,
    HardwareComponentState,
    HardwareInterface,
)
from ros2controlcli.diagram import Arrow, as_dot, as_svg, Diagram, diagram_of

WHEELS = ('left/velocity', 'right/velocity')


def _diagram() -> Diagram:
    """Return the diagram of a drive that commands a PID, which commands wheels."""
    interfaces = [HardwareInterface(name=name) for name in WHEELS]
    return diagram_of(
        [
            ControllerState(
                name='drive',
                state='active',
                claimed_interfaces=['pid/speed'],
                required_command_interfaces=['pid/speed'],
                required_state_interfaces=['pid/speed_out'],
                chain_connections=[ChainConnection(name='pid', reference_interfaces=['speed'])],
            ),
            ControllerState(
                name='pid',
                state='inactive',
                required_command_interfaces=WHEELS,
                required_state_interfaces=['left/velocity', 'of/nobody'],
                reference_interfaces=['speed'],
                exported_state_interfaces=['pid/speed_out'],
            ),
        ],
        [
            HardwareComponentState(
                name='wheels', command_interfaces=interfaces, state_interfaces=interfaces
            )
        ],
    )


def test_arrows() -> None:
    """They follow the chain; those of a controller that is not active are not in use."""
    assert set(_diagram().arrows) == {
        Arrow('drive', 'pid', ('pid/speed',), True, True),
        Arrow('pid', 'drive', ('pid/speed_out',), True, False),
        Arrow('pid', 'wheels', WHEELS, False, True),
        Arrow('wheels', 'pid', ('left/velocity',), False, False),
    }


def test_many_interfaces_are_abbreviated() -> None:
    """An arrow names some of its interfaces, and how many there are besides."""
    arrow = Arrow('a', 'b', tuple('abcdefg'), True, True)
    assert arrow.label == ('a', 'b', 'c', 'd', 'and 3 more')


def test_dot() -> None:
    """Names of any kind are quoted."""
    text = as_dot(Diagram((), (Arrow('a"b', 'c', ('x', 'y'), False, True),)))
    assert '"a\\"b" -> "c" [label="x\\ny" style=dashed' in text


def test_svg() -> None:
    """Those who command are at the left, and a loop is drawn as well."""
    root = ElementTree.fromstring(as_svg(_diagram()))
    texts = [(each.text, float(each.attrib['x'])) for each in root.iter() if 'x' in each.attrib]
    xs = {text: x for text, x in texts if text in ('drive', 'pid', 'wheels')}
    assert xs['drive'] < xs['pid'] < xs['wheels']
    loop = Diagram(_diagram().boxes, (Arrow('pid', 'drive', ('a',), True, True),) * 2)
    ElementTree.fromstring(as_svg(loop))
    ElementTree.fromstring(as_svg(Diagram((), ())))
