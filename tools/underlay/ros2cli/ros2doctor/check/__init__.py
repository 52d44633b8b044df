# SPDX-License-Identifier: Apache-2.0
"""What is wrong with the facts, one check a module."""
