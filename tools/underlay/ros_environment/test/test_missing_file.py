# SPDX-License-Identifier: Apache-2.0
"""Tests of the explanation why a file is not found."""

from __future__ import annotations

from pathlib import Path

import pytest
from ros_environment.missing_file import explain_missing_file


@pytest.fixture(autouse=True)
def _files(workspace: Path) -> None:
    """Put two files into the current folder."""
    folder = workspace / 'config'
    folder.mkdir()
    (folder / 'robot.yaml').touch()
    (folder / 'arm.yaml').touch()
    (folder / 'link.yaml').symlink_to('nowhere')


@pytest.mark.parametrize(
    ('path', 'explanation'),
    [
        ('config/robt.yaml', "does not exist. Did you mean 'robot.yaml'?"),
        ('config/x', 'does not exist. This folder contains: arm.yaml, link.yaml, robot.yaml'),
        ('confg/x', "does not exist: there is no folder 'confg'"),
        ('src/confg/x', "does not exist: there is no folder 'src/confg'"),
        ('config', 'is a folder'),
        ('config/link.yaml', "is a broken symbolic link to 'nowhere'"),
    ],
)
def test_missing_file(path: str, explanation: str) -> None:
    """A similar name, what there is, or what the path is instead of a file."""
    assert explain_missing_file('file', path) == f"the file '{path}' {explanation}"


def test_files_that_are_not_suggested(workspace: Path) -> None:
    """A launch file is not told to include itself."""
    but = {str(workspace / 'config' / 'robot.yaml')}
    text = explain_missing_file('file', 'config/robt.yaml', but)
    assert 'robot.yaml' not in text and 'arm.yaml' in text
