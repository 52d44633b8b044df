# SPDX-License-Identifier: Apache-2.0
"""Check that source files say who holds their copyright and under which licence."""
