# SPDX-License-Identifier: Apache-2.0
"""The error of a substitution that has no text."""

from __future__ import annotations


class SubstitutionFailure(RuntimeError):
    """A substitution cannot be performed; the text says why."""
