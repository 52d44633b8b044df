# SPDX-License-Identifier: Apache-2.0
"""Requests of services as texts that somebody fills."""

from __future__ import annotations

from builtin_interfaces.msg import Time
import pytest
from rcl_interfaces.srv import SetParameters
from robot_console.panels.services import (
    fields_text,
    filled,
    response_text,
    service_class,
    template,
)
from std_srvs.srv import Empty, SetBool, Trigger

NOW = Time(sec=7)


def test_template() -> None:
    """The template has all fields; as it is, it is a request with the defaults."""
    assert template(SetBool) == 'data: false\n'
    assert template(Trigger) == '' and fields_text(Trigger) == ''
    assert fields_text(SetBool) == 'data: bool'
    assert fields_text(SetBool, 'Response') == 'success: bool, message: string'
    assert filled(SetParameters, template(SetParameters), NOW) == SetParameters.Request()


def test_filled() -> None:
    """A text in YAML becomes a request; fields that are left out have their defaults."""
    assert filled(SetBool, 'data: true', NOW).data is True
    assert filled(Trigger, '', NOW) == Trigger.Request()
    text = '{parameters: [{name: a, value: {type: 2, integer_value: 5}}]}'
    assert filled(SetParameters, text, NOW).parameters[0].value.integer_value == 5


@pytest.mark.parametrize(
    ('text', 'reason'),
    [
        ('data: [', 'is not valid YAML'),
        ('true', 'dictionary'),
        ('dat: true', 'data'),
        ('data: {a: 1}', 'true or false'),
    ],
)
def test_wrong_requests(text: str, reason: str) -> None:
    """What is no request is refused with the reason."""
    with pytest.raises(ValueError, match=reason):
        filled(SetBool, text, NOW)


def test_class() -> None:
    """A type that is not installed is named."""
    assert service_class('std_srvs/srv/Trigger') is Trigger
    with pytest.raises(ValueError, match='nothing_here'):
        service_class('nothing_here/srv/Trigger')


def test_response() -> None:
    """A response is shown as YAML, and a huge one shortened."""
    assert response_text(SetBool.Response(message='ok')) == 'success: false\nmessage: ok\n'
    assert 'no fields' in response_text(Empty.Response())
    assert len(response_text(Trigger.Response(message='m' * 99999))) < 1000
