/** Words of English, German and Portuguese that a text is told by. */

/** A hand is raised in greeting. */
export const GREETING = /^(hello|hi|hey|welcome|goodbye|bye|greetings|hallo|willkommen|tschüss|servus|olá|oi|tchau|adeus|bem-vindos?|bem-vindas?)$/i;
/** Words of English, German and Portuguese that no beat falls on, if they are as long as others that one falls on. */
export const SMALL = new Set(
  (
    'a an and are as at be been but by can could did do does for from had has have he her hers him his how i if in into is it its just may me might must my no nor not of on or our ' +
    'shall she should so some than that the their them then there these they this those to up us was we were what when where which who whom why will with would you your ' +
    'aber alle als also auch auf aus bei bist dann dass dein deine dem den denn der des dich dich die dies diese dieser dir doch durch eine einem einen einer eines euch euer für gegen haben hast hatte ' +
    'ihre ihrem ihren ihrer immer jede jeder kann kein keine mehr mein meine meinem meinen meiner mich mit muss nach nicht noch nur oder ohne schon sein seine seinem seinen seiner sich sind so sondern ' +
    'soll über und uns unser unter viel vom von vor wann war waren warum was weil welche wenn wer werden wie wieder will wir wird wo wurde zum zur zwischen ' +
    'como com das dela dele depois dessa desse desta deste disso dos ela elas ele eles entre era eram essa esse esta está estão estas este estes eu foi foram isso isto já lhe mais mas mesmo meu meus minha ' +
    'muito nas nem nos nós não nossa nosso num numa onde para pela pelo por porque porquê quando que quem são se sem ser seu seus sobre sua suas também tem tenho ter teu teus tinha toda todas todo todos tua tudo uma umas você vocês'
  ).split(' '),
);

/** What a box for one's own words says before anything is written there. */
export const INVITATIONS: Record<string, string> = {
  en: 'Hello there! Shall I tell you a secret? :)',
  de: 'Hallo! Soll ich dir ein Geheimnis verraten? :)',
  pt: 'Olá! Queres que te conte um segredo? :)',
};
