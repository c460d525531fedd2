//! Units of measure after numbers.

use super::grammar::Form;
use super::language::Language;

/// Unit of measurement: its sign, and its singular and plural names in each language.
pub(super) struct Unit {
    sign: &'static str,
    names: [[&'static str; 2]; 3],
    /// True for feminine gender, in German and Portuguese.
    feminine: [bool; 2],
    /// True if it may be a separate word after a number; others are other words too.
    apart: bool,
}

const fn unit(sign: &'static str, names: [[&'static str; 2]; 3]) -> Unit {
    Unit {
        sign,
        names,
        feminine: [false, false],
        apart: true,
    }
}

const fn attached(sign: &'static str, names: [[&'static str; 2]; 3]) -> Unit {
    Unit {
        sign,
        names,
        feminine: [false, false],
        apart: false,
    }
}

const fn gendered(sign: &'static str, feminine: [bool; 2], names: [[&'static str; 2]; 3]) -> Unit {
    Unit {
        sign,
        names,
        feminine,
        apart: true,
    }
}

const UNITS: &[Unit] = &[
    unit("%", [["percent"; 2], ["Prozent"; 2], ["por cento"; 2]]),
    unit(
        "\u{2030}",
        [["per mille"; 2], ["Promille"; 2], ["por mil"; 2]],
    ),
    Unit {
        sign: "x",
        names: [["time", "times"], ["mal"; 2], ["vez", "vezes"]],
        feminine: [false, true],
        apart: false,
    },
    unit(
        "km",
        [
            ["kilometre", "kilometres"],
            ["Kilometer"; 2],
            ["quilómetro", "quilómetros"],
        ],
    ),
    unit(
        "m",
        [["metre", "metres"], ["Meter"; 2], ["metro", "metros"]],
    ),
    unit(
        "cm",
        [
            ["centimetre", "centimetres"],
            ["Zentimeter"; 2],
            ["centímetro", "centímetros"],
        ],
    ),
    unit(
        "mm",
        [
            ["millimetre", "millimetres"],
            ["Millimeter"; 2],
            ["milímetro", "milímetros"],
        ],
    ),
    gendered(
        "mi",
        [true, true],
        [["mile", "miles"], ["Meile", "Meilen"], ["milha", "milhas"]],
    ),
    unit("ft", [["foot", "feet"], ["Fuß"; 2], ["pé", "pés"]]),
    attached(
        "in",
        [["inch", "inches"], ["Zoll"; 2], ["polegada", "polegadas"]],
    ),
    gendered(
        "yd",
        [false, true],
        [["yard", "yards"], ["Yard", "Yards"], ["jarda", "jardas"]],
    ),
    unit(
        "kg",
        [
            ["kilogram", "kilograms"],
            ["Kilogramm"; 2],
            ["quilograma", "quilogramas"],
        ],
    ),
    unit("g", [["gram", "grams"], ["Gramm"; 2], ["grama", "gramas"]]),
    unit(
        "mg",
        [
            ["milligram", "milligrams"],
            ["Milligramm"; 2],
            ["miligrama", "miligramas"],
        ],
    ),
    gendered(
        "t",
        [true, true],
        [
            ["tonne", "tonnes"],
            ["Tonne", "Tonnen"],
            ["tonelada", "toneladas"],
        ],
    ),
    gendered(
        "lb",
        [false, true],
        [["pound", "pounds"], ["Pfund"; 2], ["libra", "libras"]],
    ),
    gendered(
        "lbs",
        [false, true],
        [["pound", "pounds"], ["Pfund"; 2], ["libra", "libras"]],
    ),
    gendered(
        "oz",
        [true, true],
        [["ounce", "ounces"], ["Unze", "Unzen"], ["onça", "onças"]],
    ),
    gendered(
        "tsp",
        [false, true],
        [
            ["teaspoon", "teaspoons"],
            ["Teelöffel"; 2],
            ["colher de chá", "colheres de chá"],
        ],
    ),
    gendered(
        "tbsp",
        [false, true],
        [
            ["tablespoon", "tablespoons"],
            ["Esslöffel"; 2],
            ["colher de sopa", "colheres de sopa"],
        ],
    ),
    unit(
        "TL",
        [["teaspoon", "teaspoons"], ["Teelöffel"; 2], ["TL"; 2]],
    ),
    unit(
        "EL",
        [["tablespoon", "tablespoons"], ["Esslöffel"; 2], ["EL"; 2]],
    ),
    unit(
        "l",
        [["litre", "litres"], ["Liter"; 2], ["litro", "litros"]],
    ),
    unit(
        "L",
        [["litre", "litres"], ["Liter"; 2], ["litro", "litros"]],
    ),
    unit(
        "ml",
        [
            ["millilitre", "millilitres"],
            ["Milliliter"; 2],
            ["mililitro", "mililitros"],
        ],
    ),
    gendered(
        "s",
        [true, false],
        [
            ["second", "seconds"],
            ["Sekunde", "Sekunden"],
            ["segundo", "segundos"],
        ],
    ),
    gendered(
        "ms",
        [true, false],
        [
            ["millisecond", "milliseconds"],
            ["Millisekunde", "Millisekunden"],
            ["milissegundo", "milissegundos"],
        ],
    ),
    gendered(
        "min",
        [true, false],
        [
            ["minute", "minutes"],
            ["Minute", "Minuten"],
            ["minuto", "minutos"],
        ],
    ),
    gendered(
        "h",
        [true, true],
        [["hour", "hours"], ["Stunde", "Stunden"], ["hora", "horas"]],
    ),
    unit(
        "km/h",
        [
            ["kilometre per hour", "kilometres per hour"],
            ["Kilometer pro Stunde"; 2],
            ["quilómetro por hora", "quilómetros por hora"],
        ],
    ),
    unit(
        "m/s",
        [
            ["metre per second", "metres per second"],
            ["Meter pro Sekunde"; 2],
            ["metro por segundo", "metros por segundo"],
        ],
    ),
    unit(
        "m/s\u{b2}",
        [
            ["metre per second squared", "metres per second squared"],
            ["Meter pro Sekunde zum Quadrat"; 2],
            [
                "metro por segundo ao quadrado",
                "metros por segundo ao quadrado",
            ],
        ],
    ),
    gendered(
        "mph",
        [true, true],
        [
            ["mile per hour", "miles per hour"],
            ["Meile pro Stunde", "Meilen pro Stunde"],
            ["milha por hora", "milhas por hora"],
        ],
    ),
    unit(
        "\u{b0}C",
        [
            ["degree Celsius", "degrees Celsius"],
            ["Grad Celsius"; 2],
            ["grau Celsius", "graus Celsius"],
        ],
    ),
    unit(
        "\u{b0}F",
        [
            ["degree Fahrenheit", "degrees Fahrenheit"],
            ["Grad Fahrenheit"; 2],
            ["grau Fahrenheit", "graus Fahrenheit"],
        ],
    ),
    unit(
        "\u{b0}",
        [["degree", "degrees"], ["Grad"; 2], ["grau", "graus"]],
    ),
    unit("Hz", [["hertz"; 2], ["Hertz"; 2], ["hertz"; 2]]),
    unit(
        "kHz",
        [["kilohertz"; 2], ["Kilohertz"; 2], ["quilohertz"; 2]],
    ),
    unit(
        "MHz",
        [["megahertz"; 2], ["Megahertz"; 2], ["megahertz"; 2]],
    ),
    unit(
        "GHz",
        [["gigahertz"; 2], ["Gigahertz"; 2], ["gigahertz"; 2]],
    ),
    unit(
        "kB",
        [
            ["kilobyte", "kilobytes"],
            ["Kilobyte"; 2],
            ["quilobyte", "quilobytes"],
        ],
    ),
    unit(
        "KB",
        [
            ["kilobyte", "kilobytes"],
            ["Kilobyte"; 2],
            ["quilobyte", "quilobytes"],
        ],
    ),
    unit(
        "MB",
        [
            ["megabyte", "megabytes"],
            ["Megabyte"; 2],
            ["megabyte", "megabytes"],
        ],
    ),
    unit(
        "GB",
        [
            ["gigabyte", "gigabytes"],
            ["Gigabyte"; 2],
            ["gigabyte", "gigabytes"],
        ],
    ),
    unit(
        "TB",
        [
            ["terabyte", "terabytes"],
            ["Terabyte"; 2],
            ["terabyte", "terabytes"],
        ],
    ),
    unit("W", [["watt", "watts"], ["Watt"; 2], ["watt", "watts"]]),
    unit(
        "kW",
        [
            ["kilowatt", "kilowatts"],
            ["Kilowatt"; 2],
            ["quilowatt", "quilowatts"],
        ],
    ),
    unit(
        "MW",
        [
            ["megawatt", "megawatts"],
            ["Megawatt"; 2],
            ["megawatt", "megawatts"],
        ],
    ),
    gendered(
        "kWh",
        [true, false],
        [
            ["kilowatt hour", "kilowatt hours"],
            ["Kilowattstunde", "Kilowattstunden"],
            ["quilowatt hora", "quilowatts hora"],
        ],
    ),
    unit("V", [["volt", "volts"], ["Volt"; 2], ["volt", "volts"]]),
    attached("A", [["amp", "amps"], ["Ampere"; 2], ["ampere", "amperes"]]),
    unit(
        "kJ",
        [
            ["kilojoule", "kilojoules"],
            ["Kilojoule"; 2],
            ["quilojoule", "quilojoules"],
        ],
    ),
    gendered(
        "kcal",
        [true, true],
        [
            ["kilocalorie", "kilocalories"],
            ["Kilokalorie", "Kilokalorien"],
            ["quilocaloria", "quilocalorias"],
        ],
    ),
    unit(
        "dB",
        [
            ["decibel", "decibels"],
            ["Dezibel"; 2],
            ["decibel", "decibéis"],
        ],
    ),
    unit(
        "Pa",
        [["pascal", "pascals"], ["Pascal"; 2], ["pascal", "pascais"]],
    ),
    unit(
        "hPa",
        [
            ["hectopascal", "hectopascals"],
            ["Hektopascal"; 2],
            ["hectopascal", "hectopascais"],
        ],
    ),
    unit(
        "m\u{b2}",
        [
            ["square metre", "square metres"],
            ["Quadratmeter"; 2],
            ["metro quadrado", "metros quadrados"],
        ],
    ),
    unit(
        "cm\u{b2}",
        [
            ["square centimetre", "square centimetres"],
            ["Quadratzentimeter"; 2],
            ["centímetro quadrado", "centímetros quadrados"],
        ],
    ),
    unit(
        "km\u{b2}",
        [
            ["square kilometre", "square kilometres"],
            ["Quadratkilometer"; 2],
            ["quilómetro quadrado", "quilómetros quadrados"],
        ],
    ),
    unit(
        "m\u{b3}",
        [
            ["cubic metre", "cubic metres"],
            ["Kubikmeter"; 2],
            ["metro cúbico", "metros cúbicos"],
        ],
    ),
    unit(
        "cm\u{b3}",
        [
            ["cubic centimetre", "cubic centimetres"],
            ["Kubikzentimeter"; 2],
            ["centímetro cúbico", "centímetros cúbicos"],
        ],
    ),
    unit(
        "ha",
        [
            ["hectare", "hectares"],
            ["Hektar"; 2],
            ["hectare", "hectares"],
        ],
    ),
];

/// Returns the unit whose sign is `text`, as a word after a number. `measured` is true if the text
/// is marked as a measure, so that even "in" counts.
pub(super) fn apart(text: &str, measured: bool) -> Option<&'static Unit> {
    UNITS
        .iter()
        .find(|unit| unit.sign == text && (unit.apart || measured))
}

/// Parts `text` in its number and the unit attached to it.
pub(super) fn split_unit(text: &str) -> Option<(&str, &'static Unit)> {
    let end = text.rfind(|c: char| c.is_ascii_digit())? + 1;
    let (number, sign) = text.split_at_checked(end)?;
    let unit = UNITS.iter().find(|unit| unit.sign == sign)?;
    Some((number, unit))
}

impl Unit {
    /// Returns the singular (`one`) or plural name of the unit.
    pub(super) fn name(&self, one: bool, language: Language) -> &'static str {
        language.pick(self.names)[usize::from(!one)]
    }

    /// Returns the form of numbers before the unit, by the gender of its name.
    pub(super) fn form(&self, language: Language) -> Form {
        let feminine = language.pick([false, self.feminine[0], self.feminine[1]]);
        if feminine {
            Form::Feminine
        } else {
            Form::Masculine
        }
    }
}
