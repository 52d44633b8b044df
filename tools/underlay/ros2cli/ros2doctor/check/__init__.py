# SPDX-License-Identifier: Apache-2.0
"""What is checked and reported, one subject per module: its facts, then the check and report."""
