# SPDX-License-Identifier: Apache-2.0
"""Find the install prefix of a package."""

from __future__ import annotations

from ament_index_python.packages import get_package_prefix, PackageNotFoundError


class _ExplainedPackageNotFoundError(PackageNotFoundError):
    """A package was not found; the message states why, as far as known."""

    def __init__(self, error: KeyError, explanation: str) -> None:
        super().__init__(*error.args)
        self._text = '\n'.join(filter(None, [str(error), explanation]))

    def __str__(self) -> str:
        return self._text


def prefix_of(package_name: str) -> str:
    """
    Return the install prefix of a package.

    Parameters
    ----------
    package_name
        The package.

    Raises
    ------
    PackageNotFoundError
        It is not installed; the message states why, as far as the workspace shows.

    """
    try:
        return str(get_package_prefix(package_name))
    except PackageNotFoundError as error:
        raise _ExplainedPackageNotFoundError(error, _explain(package_name)) from None


def _explain(package_name: str) -> str:
    """Explain a missing package from the workspace around the current directory."""
    from ros_environment.workspace import explain_missing_package

    return explain_missing_package(package_name)
