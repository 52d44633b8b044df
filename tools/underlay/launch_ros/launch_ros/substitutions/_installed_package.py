# SPDX-License-Identifier: Apache-2.0
"""Look up where a package is installed."""

from __future__ import annotations

from ament_index_python.packages import get_package_prefix, PackageNotFoundError


class _ExplainedPackageNotFoundError(PackageNotFoundError):
    """A package was not found; the text says why, as far as it is known."""

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
        It is not installed; the text says why, as far as the workspace tells.

    """
    try:
        return str(get_package_prefix(package_name))
    except PackageNotFoundError as error:
        raise _ExplainedPackageNotFoundError(error, _explain(package_name)) from None


def _explain(package_name: str) -> str:
    """Return what the workspace around the current folder tells about a package."""
    try:
        from ros_environment.workspace import explain_missing_package
    except ImportError:
        return ''
    return str(explain_missing_package(package_name))
