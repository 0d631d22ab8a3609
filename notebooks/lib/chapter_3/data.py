"""Data published by others.

`TRANSISTORS` is the largest microprocessor of each year in the table of Rupp (2022; CC BY 4.0), in thousands of
transistors: the file "50yrs/transistors.dat" of github.com/karlrupp/microprocessor-trend-data, rounded to three digits.
Up to 2010 that table was itself collected by Horowitz and others. Years without an entry there have none here.
"""

TRANSISTORS = {
    1971: 2.31, 1972: 3.55, 1974: 6.10, 1979: 29.2, 1982: 136, 1985: 274, 1986: 109, 1988: 122, 1989: 1_210,
    1990: 1_210, 1992: 3_110, 1993: 3_110, 1994: 2_790, 1995: 9_650, 1996: 9_650, 1997: 8_900, 1998: 15_300,
    1999: 21_700, 2000: 37_200, 2001: 42_600, 2002: 221_000, 2003: 151_000, 2004: 274_000, 2005: 305_000, 2006: 583_000,
    2007: 806_000, 2008: 509_000, 2009: 2_310_000, 2010: 1_310_000, 2011: 2_600_000, 2012: 2_400_000, 2013: 5_000_000,
    2014: 5_700_000, 2016: 8_000_000, 2017: 19_200_000, 2018: 21_100_000, 2019: 39_500_000, 2020: 30_400_000,
    2021: 58_200_000,
}
