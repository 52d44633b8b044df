# SPDX-License-Identifier: Apache-2.0
"""The substitutions that look up packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.substitutions import SubstitutionFailure, TextSubstitution
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare
import pytest

Install = Callable[..., Path]


def test_folders_of_a_package(context: LaunchContext, prefix: Install) -> None:
    """The folders are looked up when they are needed, and can be joined with more."""
    root = prefix('pkg')
    assert FindPackagePrefix(['p', TextSubstitution(text='kg')]).perform(context) == str(root)
    share = FindPackageShare('pkg')
    assert share.perform(context) == f'{root}/share/pkg'
    assert (share / 'launch' / 'x.py').perform(context) == f'{root}/share/pkg/launch/x.py'
    assert share.describe() == "FindPackageShare(pkg='pkg')"


def test_unknown_package(context: LaunchContext, prefix: Install) -> None:
    """The error begins with the package and where it was looked for."""
    root = prefix('pkg')
    with pytest.raises(KeyError) as error:
        FindPackageShare('other').perform(context)
    first = str(error.value).splitlines()[0]
    assert first == f'''"package 'other' not found, searching: ['{root}']"'''


def test_invalid_name_of_a_package(context: LaunchContext, prefix: Install) -> None:
    """A name that no package can have is an error of its own."""
    prefix('pkg')
    with pytest.raises(ValueError, match="'a/b' is not a valid package name"):
        FindPackageShare('a/b').perform(context)


def test_executable(context: LaunchContext, prefix: Install) -> None:
    """The executable lies directly in the folder of the package."""
    root = prefix('pkg', 'talker')
    found = ExecutableInPackage('talker', 'pkg')
    assert found.perform(context) == f'{root}/lib/pkg/talker'
    assert found.describe() == "ExecInPkg(pkg='pkg', exec='talker')"


@pytest.mark.parametrize(
    'executables, text',
    [
        (['talker'], "executable 'listener' not found on the libexec directory '{root}/lib/pkg' "),
        (
            [],
            "package 'pkg' found at '{root}', but libexec directory "
            "'{root}/lib/pkg' does not exist",
        ),
    ],
)
def test_missing_executable(
    context: LaunchContext,
    prefix: Install,
    executables: Any,
    text: str,
) -> None:
    """The error tells whether the folder or the file is missing."""
    root = prefix('pkg', *executables)
    with pytest.raises(SubstitutionFailure) as error:
        ExecutableInPackage(executable='listener', package='pkg').perform(context)
    assert str(error.value).splitlines()[0] == text.format(root=root)


def test_file_that_may_not_be_executed(context: LaunchContext, prefix: Install) -> None:
    """A file is an executable only if its mode says so."""
    root = prefix('pkg', 'talker')
    (root / 'lib/pkg/talker').chmod(0o644)
    with pytest.raises(SubstitutionFailure, match="'talker' not found on the libexec"):
        ExecutableInPackage('talker', 'pkg').perform(context)
