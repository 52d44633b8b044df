# SPDX-License-Identifier: Apache-2.0
"""Error messages for packages that are not installed."""

from __future__ import annotations


def missing_package(package: str) -> str:
    """
    Format the error message of `prefix` and `xml` for a package that is not found.

    Parameters
    ----------
    package
        The package as the user wrote it.

    Returns
    -------
    str
        A line without the name, then the cause and the remedy if they are known.

    """
    from ros_environment.workspace import explain_missing_package

    return '\n'.join(['Package not found', explain_missing_package(package)]).rstrip()


def missing_package_by_name(package: str, detail: str = '') -> str:
    """
    Format the error message that names a package that is not found.

    Parameters
    ----------
    package
        The package as the user wrote it.
    detail
        A detail to append to the first line, after a colon.

    Returns
    -------
    str
        The line with the name, then the cause and the remedy if they are known.

    """
    from ros_environment.workspace import explain_missing_package

    text = f"Package '{package}' not found" + (f': {detail}' if detail else '')
    return '\n'.join([text, explain_missing_package(package)]).rstrip()
