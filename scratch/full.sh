cd /work/wt/loop; build/bin/checkIdentification tests/identification/standIn/study.yaml --libraries ${1:-8} --nulls ${2:-6} --effects ${3:-14} --seed ${4:-1} ${@:5} --output /tmp/full.json 2>&1 >/dev/null | tail -1
python3 - <<'P'
import json
r=json.load(open('/tmp/full.json'))
for k,v in r['byEffect'].items():
    g=lambda n:"%d/%d"%(v[n].get('count',0),v[n]['of'])
    print("%16s det %s top %s set %s size %.1f named %s right %s cov %s other %s"%(k,g('detected'),g('topOneWhenDetected'),g('truthInSetWhenDetected'),v['meanSetSize'] or 0,g('namedWhenDetected'),g('namedRightly'),g('intervalCoversWhenDetected'),g('somethingElseWhenDetected')))
for k,v in r['bySize'].items(): print(k,v['detected'].get('share'),v['namedWhenDetected'].get('share'),v['intervalCoversWhenDetected'].get('share'))
for k,v in r['outsideLibrary'].items(): print(k,'det',v['detected'].get('share'),'wrong',v['wrongNameWhenDetected'].get('share'),'other',v['somethingElseWhenDetected'].get('share'),'unknown',v['unknownWhenDetected'].get('share'))
P
