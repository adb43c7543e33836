# SPDX-License-Identifier: GPL-2.0-or-later
"""Readers of instruments' files for strait_import."""
