# SPDX-License-Identifier: Apache-2.0
"""Tools to run processes in tests and to match their output."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing.tools import output, process, text
    from launch_testing.tools.output import (
        basic_output_filter,
        expect_output,
        expected_output_from_file,
        get_default_filtered_patterns,
        get_default_filtered_prefixes,
    )
    from launch_testing.tools.process import launch_process, ProcessProxy
    from launch_testing.tools.text import build_line_match, build_text_match

__all__ = [
    'ProcessProxy',
    'basic_output_filter',
    'build_line_match',
    'build_text_match',
    'expect_output',
    'expected_output_from_file',
    'get_default_filtered_patterns',
    'get_default_filtered_prefixes',
    'launch_process',
    'output',
    'process',
    'text',
]

_ELSEWHERE = {
    'ProcessProxy': 'process',
    'basic_output_filter': 'output',
    'build_line_match': 'text',
    'build_text_match': 'text',
    'expect_output': 'output',
    'expected_output_from_file': 'output',
    'get_default_filtered_patterns': 'output',
    'get_default_filtered_prefixes': 'output',
    'launch_process': 'process',
    'output': '',
    'process': '',
    'text': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
