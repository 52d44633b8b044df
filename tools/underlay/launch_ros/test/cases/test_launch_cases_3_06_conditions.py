# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.6: conditions."""

from __future__ import annotations

from typing import Any

import pytest


def test_the_four_words(launch: Any) -> None:
    """3.6 true and 1, false and 0 are understood, in any case and with space around."""
    values = ['true', '1', ' TRUE ', '1\\n', 'false', '0', 'False ', '\\t0']
    out = launch(
        ''.join(
            f"LogInfo(msg='{n} if', condition=IfCondition('{value}')),\n"
            f"LogInfo(msg='{n} unless', condition=UnlessCondition(['{value}'])),\n"
            for n, value in enumerate(values)
        )
    )
    assert out.said == [f'{n} if' if n < 4 else f'{n} unless' for n in range(8)]


@pytest.mark.parametrize(
    ('condition', 'value'),
    [
        ('IfCondition', ''),
        ('IfCondition', 'yes'),
        ('UnlessCondition', 'None'),
        ('UnlessCondition', '2'),
    ],
)
def test_other_words(condition: str, value: str, launch: Any) -> None:
    """3.6 Any other word, also none, is an error."""
    out = launch(
        f"LogInfo(msg='x', condition={condition}(LaunchConfiguration('a', default='{value}'))),"
    )
    assert (out.status, out.said) == (1, [])
    assert out.error.startswith(
        'invalid condition expression, expected one of [true, 1, false, 0] but got '
        f"'{value.lower()}', expanded from '"
    )


def test_a_bool_is_no_condition(launch: Any) -> None:
    """3.6 A condition takes texts and substitutions only."""
    out = launch("LogInfo(msg='x', condition=IfCondition(True)),")
    assert out.status == 1
    assert ' - TypeError: ' in out.error


def test_comparisons_with_a_configuration(launch: Any) -> None:
    """3.6 A configuration is compared as a text; None stands for one that is not set."""
    out = launch(
        """
        equal, other = LaunchConfigurationEquals, LaunchConfigurationNotEquals
        ---
        SetLaunchConfiguration('a', '1'),
        LogInfo(msg='1 equal', condition=equal('a', '1')),
        LogInfo(msg='1.0 equal', condition=equal('a', '1.0')),
        LogInfo(msg='1 other', condition=other('a', '1')),
        LogInfo(msg='1.0 other', condition=other('a', '1.0')),
        LogInfo(msg='set', condition=other('a', None)),
        LogInfo(msg='unset', condition=equal('b', None)),
        LogInfo(msg='b equal', condition=equal('b', 'x')),
        LogInfo(msg='keywords', condition=equal(
            launch_configuration_name='a', expected_value=['', '1'])),
        """
    )
    assert out.status == 0
    assert out.said == ['1 equal', '1.0 other', 'set', 'unset', 'keywords']
    assert 'UserWarning' in out.err


def test_conditions_of_ones_own(launch: Any) -> None:
    """3.6 A condition may be made of a function, or be anything that can evaluate()."""
    out = launch(
        """
        class Own:
            def evaluate(self, context):
                return context.launch_configurations['a'] == '1'
        ---
        SetLaunchConfiguration('a', '1'),
        LogInfo(msg='function', condition=Condition(
            predicate=lambda context: context.launch_configurations['a'] == '1')),
        LogInfo(msg='false', condition=Condition(predicate=lambda context: False)),
        LogInfo(msg='own', condition=Own()),
        LogInfo(msg=repr(Condition().evaluate(LaunchContext()))),
        LogInfo(msg=type(IfCondition('1').describe()).__name__),
        """
    )
    assert out.said == ['function', 'own', 'False', 'str']
