"""Accuracy against time: what each knob of [accuracy] costs and what it is worth, measured."""
