# SPDX-License-Identifier: Apache-2.0
"""A template that does not do its work."""


class TemplateFailure(Exception):
    """The template cannot make a process; the text says why."""
