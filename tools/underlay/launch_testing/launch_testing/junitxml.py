# SPDX-License-Identifier: Apache-2.0
"""Export test results as JUnit XML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import re
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from launch_testing.test_result import ERROR, FAILED, Outcome, SKIPPED

if TYPE_CHECKING:
    from launch_testing.test_result import TestResult

_NOT_IN_XML = re.compile('[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]')
_TAGS = {FAILED: 'failure', ERROR: 'error', SKIPPED: 'skipped'}


def unittestResultsToXml(  # noqa: N802
    *,
    name: str = 'launch_test',
    test_results: Mapping[str, TestResult],
) -> ElementTree.ElementTree:
    """
    Convert the results of several runs into a JUnit XML document.

    Parameters
    ----------
    name
        The name of the document, also used as the prefix of class names.
    test_results
        The results by run name; each becomes a test suite.

    """
    root = ElementTree.Element('testsuites', {'name': name})
    everything = [each for result in test_results.values() for each in result.outcomes]
    root.attrib.update(_counts(everything))
    for run_name, result in test_results.items():
        root.append(_suite(run_name, f'{name}.{run_name}', result.outcomes))
    return ElementTree.ElementTree(root)


def _suite(name: str, class_prefix: str, outcomes: list[Outcome]) -> ElementTree.Element:
    suite = ElementTree.Element('testsuite', {'name': name, **_counts(outcomes)})
    suite.extend(_case(class_prefix, outcome) for outcome in outcomes)
    return suite


def _counts(outcomes: Iterable[Outcome]) -> dict[str, str]:
    """Count the outcomes for the attributes of a test suite."""
    all_of_them = list(outcomes)
    kinds = [each.outcome for each in all_of_them]
    return {
        'tests': str(len(kinds)),
        'failures': str(kinds.count(FAILED)),
        'errors': str(kinds.count(ERROR)),
        'skipped': str(kinds.count(SKIPPED)),
        'time': f'{sum(each.duration_s for each in all_of_them):.3f}',
    }


def _case(class_prefix: str, outcome: Outcome) -> ElementTree.Element:
    case = ElementTree.Element(
        'testcase',
        {
            'classname': f'{class_prefix}.{outcome.class_name}',
            'name': outcome.name,
            'time': f'{outcome.duration_s:.3f}',
        },
    )
    tag = _TAGS.get(outcome.outcome)
    if tag is not None:
        message = _NOT_IN_XML.sub('?', outcome.message)
        last_line = (message.strip().splitlines() or [''])[-1]
        ElementTree.SubElement(case, tag, {'message': last_line}).text = message
    return case
