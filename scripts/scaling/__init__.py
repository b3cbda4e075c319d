# SPDX-License-Identifier: BSD-3-Clause
"""The scaling harness behind scripts/scaling.py: sweeps over ranks, threads, methods and points; tables, plots, model.

errors: what ends a command. sweep: from an ini to cases. machine: what the times stand on. backends: how a case is run.
record: the numbers of one run. measure: all runs in turn. summary: from runs to rows with efficiencies. tables, plots,
compare: what is made of the rows. model, traffic_model, model_report: the time as a sum of terms, fitted, checked and
extrapolated; least_squares: how.
"""
