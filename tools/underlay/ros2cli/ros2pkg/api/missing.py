# SPDX-License-Identifier: Apache-2.0
"""Error texts of the verbs for packages that are not installed."""

from __future__ import annotations


def missing_package(package: str) -> str:
    """Return the short text of `prefix` and `xml`, with the cause and the cure if known."""
    from ros_environment.workspace import explain_missing_package

    return '\n'.join(['Package not found', explain_missing_package(package)]).rstrip()


def missing_package_by_name(package: str, detail: str = '') -> str:
    """Return the text that names the package, with the cause and the cure if known."""
    from ros_environment.workspace import explain_missing_package

    text = f"Package '{package}' not found" + (f': {detail}' if detail else '')
    return '\n'.join([text, explain_missing_package(package)]).rstrip()
