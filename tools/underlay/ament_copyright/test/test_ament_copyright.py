# SPDX-License-Identifier: Apache-2.0
"""Tests of the copyright check."""

from __future__ import annotations

from pathlib import Path

from ament_copyright.main import main, read_header
import pytest

NOTICE = '# Copyright 2026 A. Person\n# Licensed under the Apache License, Version 2.0\n'


def test_a_notice_with_a_licence_is_complete() -> None:
    """A holder and a licence before the first statement are enough."""
    assert read_header(NOTICE + 'import os\n').defect == ''


def test_a_notice_behind_code_does_not_count() -> None:
    """A notice has to come first."""
    assert 'copyright notice' in read_header('import os\n' + NOTICE).defect


def test_a_holder_alone_lacks_a_licence() -> None:
    """Who holds the copyright is half of it."""
    assert 'licence' in read_header('# Copyright 2026 A. Person\nimport os\n').defect


def test_spdx_lines_are_a_notice() -> None:
    """The two SPDX lines say all."""
    text = '# SPDX-FileCopyrightText: 2026 A\n# SPDX-License-Identifier: MIT\n'
    assert read_header(text).defect == ''


def test_the_command_names_the_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Files without a notice are named, empty ones pass."""
    (tmp_path / 'good.py').write_text(NOTICE)
    (tmp_path / 'bad.py').write_text('import os\n')
    (tmp_path / '__init__.py').touch()
    assert main([str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert err == f'{tmp_path}/bad.py: could not find copyright notice\n'
    assert out == '1 errors, checked 3 files\n'
    (tmp_path / 'bad.py').write_text(NOTICE)
    assert main([str(tmp_path)]) == 0


def test_a_missing_path_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    """A path that does not exist is not a folder without problems."""
    assert main(['/no/such/folder']) == 1
    assert "'/no/such/folder' does not exist" in capsys.readouterr().err
