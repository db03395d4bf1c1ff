from peenflow.case.lines import key_lines, line_of

TEXT = '''# a comment = no key
title = """one # two
three = 3"""
a.b = 1

[shot]  # comment
"diameter" = "1 mm"
"quoted.key" = 'x'
list = [
  1,  # one
  { x = [2, 3], y = "]" },
]

[[nozzle]]
speed = "1 m/s"
[[nozzle]]
position = ["0 mm", "0 mm",
  "31 mm"]
travel = { from = "1 mm", to = "2 mm" }
[nozzle.inner]
key = 1979-05-27T07:32:00Z
'''


def test_every_key_has_its_line() -> None:
    assert key_lines(TEXT) == {
        ("title",): 2,
        ("a",): 4,
        ("a", "b"): 4,
        ("shot",): 6,
        ("shot", "diameter"): 7,
        ("shot", "quoted.key"): 8,
        ("shot", "list"): 9,
        ("shot", "list", 0): 10,
        ("shot", "list", 1): 11,
        ("shot", "list", 1, "x"): 11,
        ("shot", "list", 1, "x", 0): 11,
        ("shot", "list", 1, "x", 1): 11,
        ("shot", "list", 1, "y"): 11,
        ("nozzle",): 14,
        ("nozzle", 0): 14,
        ("nozzle", 0, "speed"): 15,
        ("nozzle", 1): 16,
        ("nozzle", 1, "position"): 17,
        ("nozzle", 1, "position", 0): 17,
        ("nozzle", 1, "position", 1): 17,
        ("nozzle", 1, "position", 2): 18,
        ("nozzle", 1, "travel"): 19,
        ("nozzle", 1, "travel", "from"): 19,
        ("nozzle", 1, "travel", "to"): 19,
        ("nozzle", 1, "inner"): 20,
        ("nozzle", 1, "inner", "key"): 21,
    }


def test_a_missing_key_is_sought_in_the_table_around_it() -> None:
    lines = key_lines(TEXT)
    assert line_of(lines, ("nozzle", 1, "rate")) == 16
    assert line_of(lines, ("target", "material")) is None
