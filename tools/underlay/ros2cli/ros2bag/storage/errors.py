# SPDX-License-Identifier: Apache-2.0
"""The base of what can go wrong with a recording."""


class BagError(RuntimeError):
    """A recording cannot be read or written; the text is a sentence for the user."""
