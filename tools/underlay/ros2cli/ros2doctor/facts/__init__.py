# SPDX-License-Identifier: Apache-2.0
"""What is the case, one subject a module; nothing is judged here."""
