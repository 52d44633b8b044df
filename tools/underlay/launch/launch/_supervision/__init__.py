# SPDX-License-Identifier: Apache-2.0
"""Start processes, read what they write, and see to it that they end."""
