//! Capitals that the word's shape does not classify: short words that people shout, acronyms that
//! look like words but are spelled, and acronyms spoken as words. The order of languages is
//! [English, German, Portuguese].

/// Common words of two and three letters, and longer ones of an unusual shape.
pub(super) const WORDS: [&str; 3] = [
    "ace act ado add age ago ah aha aid ail aim air ale all am an and ant any ape apt arc are arm \
     art as ash ask at ate awe axe aye bad bag ban bar bat bay be bed bee beg bet bib bid big bin \
     bit boa bob bog bow box boy bra bud bug bum bun bus but buy by bye cab can cap car cat cob \
     cod cop cot cow coy cry cub cue cup cut dab dad dam day den dew did die dig dim din dip do doe \
     dog don dot dry dub due dug dye ear eat eel egg ego elf elk elm end era eve ewe eye fab fad \
     fan far fat fax fed fee few fib fig fin fir fit fix flu fly foe fog for fox fry fun fur gag \
     gap gas gay gel gem get gig gin go god got gum gun gut guy gym ha had hah ham has hat hay he \
     hem hen her hew hey hi hid him hip his hit ho hog hop hot how hub hue hug huh hum hut ice icy \
     if ill in ink inn ion is it its ivy jab jam jar jaw jay jet job jog joy jug keg key kid kin \
     kit lab lad lag lap law lay led leg let lid lie lip lit lo log lot low mad man map mat may me \
     men met mid mix mob mom mop mud mug mum my nag nap nay net new next nil nip no nod nor not now \
     nun nut oak oar odd of off oh oil old on one oops or ore our out ow owe owl own pad pal pan \
     paw pay pea peg pen pet pie pig pin pip pit ply pod pop pot pro pub pun pup put rag ram ran \
     rap rat raw ray red rib rid rig rim rip rob rod rot row rub rug rum run rut rye sad sag sap \
     sat saw say sea see set sew sex she shy sin sip sir sit six ski sky sly so sob son sow soy spa \
     spy sub sue sum sun tab tag tan tap tar tax tea ten the thy tie tin tip to toe ton too top tow \
     toy try tub tug two ugh ugly up urn us use van vat vet vow wag war was wax way we web wed wee \
     wet who why wig win wit woe wok won woo wow yak yes yet you yum zip zoo argh brr hmm hush pfft psst shh tsk ugh zzz",
    "aal ab abt ach acht adel ah aha akt alb all alm als alt am amt an ank arg arm art arzt ast auf \
     aus axt bad bar bau bei bin bis bist boa bub bug da dach damm das dem den der des dich dick \
     die dies dir doch dort du dumm dunk ehe ei ein eis elf eng er erst es euch euer fad fern fest \
     fix flog floh froh für fuß gab gar gas geh gib gold gott gut haar halt hat heu hey hi hier hin \
     hof hoch huhn hund hut ich igel ihm ihn ihr im in ins ist ja jäh je job juhu kam kein klug kuh \
     kurz lag laß lauf leg lies log los luft mag mal man mehr mein mich mir mist mit mund mut nach \
     nah nase neid nein nest neu nicht nie noch not nu nun nur nuß ob oder oh ohr oma ohne öl opa \
     ort ost paß pfui pst rat rad reh rot ruf ruh rund sag sah satz schon see sei sie sind so sog \
     soll sohn tag tat tal tee tod toll tor tot tu tun tür uhr um und uns ur us vom von vor wald \
     wann war warm was weg weh weit wem wen wer wie will wir wo wohl wort wut zu zug zum zur zwei brr hmm obst oft pst süd",
    "ah ai aí alô amo ao aos ar as às asa até avó avô aço bar bem boa bom cá cão céu cem chá com cor \
     da dá dado dar das de dei dela dele der deu dez dia dias dó do dois dom dor dos duas dê e é eh \
     ei ela ele em era és eu eva fé faz fez fim foi fui giz gás há ia ir irmã isso isto já lá lã \
     lar lei ler leva lhe li lua lume luz mal mar mas mau mãe mão me mel mês meu mil mim mó mãos na \
     nada não nas nem no nó nos nós nu ó oh oi ola olá on os ou ovo pá pão pai pau paz pé pela pelo \
     por pôr pó pois qual que quê quem rei ré rio rir rua sal se sé seja sei sem ser seu sim só sol \
     som sou sua sul são ta tal tão te tem têm ter teu ti tia tio tom três tu tua um uma uns vai vão \
     vás vaz vê vela velo vem vez vi via vida vil vim vir viu voo vos vós voz ali ás boi crê lês num ri riu si ui ver",
];

/// Spelled, though they could be words, or are by shape.
pub(super) const LETTERS: [&str; 3] = [
    "AA AAA ABC ADA AI AKA AOL API APR ASAP ATM BA BAE CEO CIA CIO COO CPU DIY DNA DOA EEG EKG EMI ER ETA \
     EU EUR EV FAQ FYI GCSE GP GPU HDMI HIV IBM ICU ID IMO IOU IPA IPO IQ IRA IRS ISO ITV IUCN IV \
     LA LED MBA MIA MOT MRI NAACP NBA NRA OAP OCD OECD OK PA PDA PE PHD PJ PR QA QC RAF REM RIP \
     RSVP SOS SUV TBA TV UAE UFO UK UN URL USA USB USSR VAT VIP VR WTO XL",
    "ABC ADAC AGB AEG AI AKW ALG AOK API ARD AZ BMI CIA DDR DIY DNA DSGVO EDV EEG EIB \
     EKG EU EZB FAZ GEZ HIV IBM ICE ID IHK ILO IQ IRA ISO LED LKA LKW NGO ÖBB OECD OK OP ORF OSZE \
     PDA PKW RAF SOS SUV TU UFO UKW URL US USA USB VIP VR WDR WG WHO ZDF",
    "AI ABC API BCE BE CDU CEO CIA CP CPLP DNA EDP EDU EUA FAQ FBI GNR HIV IBM ID INE IPO IRS ISO LED \
     OCDE ONG PDF PS PSD PSP RTP SA SOS TAC TV UE UFO USB VIP VR XL",
];

/// Acronyms read as words, in all languages.
pub(super) const NAMES: &str = "ACAS AIDS AWOL BAFTA BAFÖG CERN COVID DAX DIN ESA EURATOM FIFA GIF \
     GIZ IKEA IVA JPEG LASER MIDI NAFTA NASA NATO NORAD ONU OPEC OTAN PIB PIN PNG RADAR RAM ROM SAP SARS SCUBA \
     SIDA SIM SOWETO SWAT TAP TED TÜV UEFA UNESCO UNICEF UNO WIFI YAML ZIP";

/// Common words, and acronyms where they are a name.
pub(super) const UNCLEAR: [&str; 3] = ["US IT WHO SAT", "", ""];
